#include "bench/synthetic_worlds.h"

#include <cmath>

#include "base/random.h"

namespace alula::bench {
namespace {

constexpr double kHalfLength = 20.0;  // m
constexpr double kHalfWidth = 12.0;
constexpr double kTriangles = 90e3;

/// Whether nothing may stand there: within 1.2 m of the camera's way.
bool OnTheWay(double x, double y) {
  for (int i = 0; i < 90; ++i) {
    const double turn = 2.0 * M_PI * i / 90.0;
    if (std::hypot(x - 9.0 * std::cos(turn), y - 5.0 * std::sin(turn)) < 1.2) return true;
  }
  return false;
}

base::Vec3 FreePlace(base::RandomStream& random) {
  for (;;) {
    const base::Vec3 at(random.Uniform(-kHalfLength + 0.5, kHalfLength - 0.5),
                        random.Uniform(-kHalfWidth + 0.5, kHalfWidth - 0.5), 0.0);
    if (!OnTheWay(at.x(), at.y())) return at;
  }
}

struct Builder {
  worlds::World world;
  double triangles = 0.0;

  void Add(const char* name, const geometry::Shape& shape, const base::Vec3& at, int material, double scale = 1.0,
           double yaw = 0.0) {
    world.objects.push_back({name, shape, {base::FromYaw(yaw), at}, material, scale, true});
    triangles += static_cast<double>(geometry::Tessellate(shape).triangles.size());
  }
  void Slab(const char* name, const base::Vec3& at, const base::Vec3& half, int material) {
    Add(name, geometry::Box{half}, at, material, 2.0);
  }
};

/// A shelf of three boards with boxes on them.
void AddShelf(Builder& b, base::RandomStream& random) {
  const base::Vec3 foot = FreePlace(random);
  const double yaw = random.Index(2) == 0 ? 0.0 : 0.5 * M_PI;
  const base::Transform X_WS{base::FromYaw(yaw), foot};
  for (int board = 0; board < 3; ++board) {
    const double z = 0.4 + 0.8 * board;
    b.Add("board", geometry::Box{{1.0, 0.3, 0.02}}, X_WS * base::Vec3(0, 0, z), 2, 1.0, yaw);
    for (int i = 0; i < 6; ++i) {
      const double half = random.Uniform(0.08, 0.15);
      const base::Vec3 at(-0.85 + 0.34 * i, random.Uniform(-0.1, 0.1), z + 0.02 + half);
      b.Add("carton", geometry::Box{{half, half, half}}, X_WS * at, 3, 0.5, yaw);
    }
  }
}

void AddTree(Builder& b, base::RandomStream& random) {
  const base::Vec3 foot = FreePlace(random);
  const double height = random.Uniform(1.5, 3.5);
  b.Add("trunk", geometry::Cylinder{random.Uniform(0.08, 0.2), 0.5 * height}, foot + base::Vec3(0, 0, 0.5 * height), 2);
  if (random.Index(2) == 0) {
    b.Add("crown", geometry::Sphere{random.Uniform(0.5, 1.1)}, foot + base::Vec3(0, 0, height), 1);
    return;
  }
  for (int tier = 0; tier < 3; ++tier) {
    b.Add("tier", geometry::Cone{1.1 - 0.25 * tier, 0.6}, foot + base::Vec3(0, 0, height + 0.5 * tier), 1);
  }
}

}  // namespace

worlds::World SyntheticHall(std::uint64_t seed) {
  Builder b;
  b.world.materials = {NoisyMaterial("floor", 1), NoisyMaterial("wall", 2), NoisyMaterial("steel", 3),
                       NoisyMaterial("goods", 4)};
  b.world.light.to_sun_W = base::Vec3(0.4, -0.5, 0.8).normalized();
  b.Slab("floor", {0, 0, -0.5}, {kHalfLength, kHalfWidth, 0.5}, 0);
  b.Slab("roof", {0, 0.5 * kHalfWidth, 6.1}, {kHalfLength, 0.5 * kHalfWidth, 0.1}, 1);  // half of it: sun comes in
  for (const double side : {-1.0, 1.0}) {
    b.Slab("wall", {side * (kHalfLength + 0.1), 0, 3}, {0.1, kHalfWidth, 3}, 1);
    b.Slab("wall", {0, side * (kHalfWidth + 0.1), 3}, {kHalfLength, 0.1, 3}, 1);
  }
  base::RandomStream random(seed, "hall");
  while (b.triangles < kTriangles) {
    AddShelf(b, random);
    b.Add("pillar", geometry::Cylinder{0.15, 3.0}, FreePlace(random) + base::Vec3(0, 0, 3), 2);
    for (int i = 0; i < 3; ++i) {
      b.Add("drum", geometry::Cylinder{0.3, 0.45}, FreePlace(random) + base::Vec3(0, 0, 0.45), 2);
    }
    b.Add("ball", geometry::Sphere{0.25}, FreePlace(random) + base::Vec3(0, 0, 0.25), 3);
    b.Add("pipe", geometry::Capsule{0.1, 2.0}, FreePlace(random) + base::Vec3(0, 0, 2.2), 2);
  }
  return std::move(b.world);
}

worlds::World SyntheticForest(std::uint64_t seed) {
  Builder b;
  b.world.materials = {NoisyMaterial("ground", 1), NoisyMaterial("leaves", 2), NoisyMaterial("bark", 3),
                       NoisyMaterial("stone", 4)};
  b.world.light.to_sun_W = base::Vec3(0.4, -0.5, 0.8).normalized();
  b.Slab("ground", {0, 0, -0.5}, {2 * kHalfLength, 2 * kHalfWidth, 0.5}, 0);
  base::RandomStream random(seed, "forest");
  while (b.triangles < kTriangles) {
    for (int i = 0; i < 3; ++i) AddTree(b, random);
    b.Add("bush", geometry::Sphere{random.Uniform(0.2, 0.5)}, FreePlace(random) + base::Vec3(0, 0, 0.2), 1);
    const base::Vec3 half(random.Uniform(0.1, 0.3), random.Uniform(0.1, 0.3), 0.15);
    b.Add("stone", geometry::Box{half}, FreePlace(random) + base::Vec3(0, 0, 0.1), 3, 1.0, random.Uniform(0, M_PI));
  }
  return std::move(b.world);
}

double TrianglesOf(const worlds::World& world) {
  double triangles = 0.0;
  for (const worlds::Object& object : world.objects) {
    triangles += static_cast<double>(geometry::Tessellate(object.shape).triangles.size());
  }
  return triangles;
}

geometry::Material NoisyMaterial(const char* name, std::uint64_t seed) {
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = 512;
  base::RandomStream random(seed, name);
  while (texture->rgb.size() < 3UL * 512 * 512) {
    texture->rgb.insert(texture->rgb.end(), 3, static_cast<std::uint8_t>(60 + random.Index(120)));
  }
  return {name, Eigen::Vector3f::Ones(), texture};
}

}  // namespace alula::bench
