#include "worlds/furniture.h"

#include <cmath>
#include <numbers>

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

Transform Upright(const Vec2& p, double z, double yaw = 0.0) { return {base::FromYaw(yaw), {p.x(), p.y(), z}}; }

/// A square of side 2·half about `middle`, seen from both sides; its texture covers it once.
void AddCard(geometry::Mesh& mesh, const Vec3& middle, const base::Quat& turn, double half) {
  constexpr double kCorners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3 normal = turn * Vec3(0.0, 0.0, side);
    for (const auto& [x, y] : kCorners) {
      const Vec3 p = middle + turn * Vec3(half * x, half * y, 0.0);
      mesh.vertices.push_back(
          {p.cast<float>(), normal.cast<float>(), Eigen::Vector2f(0.5 * (x + 1.0), 0.5 * (y + 1.0))});
    }
    const std::uint32_t left = side > 0.0 ? 1 : 3;
    mesh.triangles.push_back({first, first + left, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 4 - left});
  }
}

/// Cards in a ball of `radius` about the origin, denser towards its skin; they stay inside it.
geometry::MeshShape Crown(double radius, int cards, RandomStream& random) {
  auto mesh = std::make_shared<geometry::Mesh>();
  for (int i = 0; i < cards; ++i) {
    const double half = radius * random.Uniform(0.22, 0.3);
    const Vec3 out = random.GaussianVec3().normalized();
    const Vec3 middle = out * ((radius - 1.42 * half) * std::cbrt(random.Uniform(0.1, 1.0)));
    const Vec3 turn = random.GaussianVec3();
    AddCard(*mesh, middle, base::Exp(turn), half);
  }
  return {mesh};
}

}  // namespace

std::size_t AddObject(World& world, std::string name, geometry::Shape shape, const Transform& X_WO, int material,
                      double texture_scale, SemanticClass semantic) {
  world.objects.push_back({std::move(name), std::move(shape), X_WO, material, texture_scale, true, semantic});
  return world.objects.size() - 1;
}

void AddTree(World& world, const Looks& looks, const std::string& name, const Footprint& at, RandomStream& random) {
  const double trunk = random.Uniform(1.5, 2.1);
  AddObject(world, name + "/trunk", geometry::Cylinder{random.Uniform(0.09, 0.17), 0.5 * trunk},
            Upright(at.centre, 0.5 * trunk), looks.bark, 0.8, SemanticClass::kTree);
  const int leaf = looks.foliage[random.Index(looks.foliage.size())];
  for (int i = 0; i < 3; ++i) {
    const double radius = at.radius * random.Uniform(0.55, 0.75);
    const double direction = 2.0 * kPi * (i + random.Uniform()) / 3.0;
    const Vec2 p = at.centre + (at.radius - radius) * Vec2(std::cos(direction), std::sin(direction));
    AddObject(world, name + "/crown" + std::to_string(i), geometry::Sphere{radius},
              Upright(p, trunk + random.Uniform(0.1, 0.8), random.Uniform(0.0, 2.0 * kPi)), leaf, 1.6,
              SemanticClass::kTree);
  }
}

void AddLeafyTree(World& world, int bark, int leaves, const std::string& name, const Footprint& at,
                  RandomStream& random) {
  constexpr int kCards = 70;
  const double trunk = random.Uniform(1.5, 2.1);
  AddObject(world, name + "/trunk", geometry::Cylinder{random.Uniform(0.09, 0.17), 0.5 * trunk},
            Upright(at.centre, 0.5 * trunk), bark, 0.8, SemanticClass::kTree);
  AddObject(world, name + "/crown", Crown(at.radius, kCards, random), Upright(at.centre, trunk + 0.6 * at.radius),
            leaves, 1.0, SemanticClass::kTree);
}

void AddConifer(World& world, const Looks& looks, const std::string& name, const Footprint& at, RandomStream& random) {
  const double bare = random.Uniform(0.3, 0.6);
  AddObject(world, name + "/trunk", geometry::Cylinder{0.2 * at.radius, 0.5 * (bare + 0.3)},
            Upright(at.centre, 0.5 * (bare + 0.3)), looks.bark, 0.8, SemanticClass::kTree);
  const int leaf = looks.foliage[random.Index(looks.foliage.size())];
  const double lower = random.Uniform(0.7, 0.9);
  const double upper = random.Uniform(0.6, 0.8);
  AddObject(world, name + "/crown0", geometry::Cone{at.radius, lower},
            Upright(at.centre, bare + lower, random.Uniform(0.0, 2.0 * kPi)), leaf, 1.6, SemanticClass::kTree);
  AddObject(world, name + "/crown1", geometry::Cone{0.75 * at.radius, upper},
            Upright(at.centre, bare + 1.1 * lower + upper, random.Uniform(0.0, 2.0 * kPi)), leaf, 1.3,
            SemanticClass::kTree);
}

void AddCrates(World& world, const Looks& looks, const std::string& name, const Footprint& at, int stacked,
               RandomStream& random) {
  double top = 0.0;
  double half = at.radius / std::numbers::sqrt2;
  for (int i = 0; i < stacked; ++i) {
    const double half_height = half * random.Uniform(0.75, 1.0);
    AddObject(world, name + "/" + std::to_string(i), geometry::Box{{half, half, half_height}},
              Upright(at.centre, top + half_height, random.Uniform(0.0, 2.0 * kPi)), looks.wood,
              random.Uniform(1.4, 2.2));
    top += 2.0 * half_height;
    half *= random.Uniform(0.8, 0.97);
  }
}

void AddPole(World& world, const Looks& looks, const std::string& name, const Footprint& at, RandomStream& random) {
  const double height = random.Uniform(2.7, 3.4);
  AddObject(world, name + "/shaft", geometry::Cylinder{0.6 * at.radius, 0.5 * height},
            Upright(at.centre, 0.5 * height, random.Uniform(0.0, 2.0 * kPi)), looks.stone, 1.1);
  AddObject(world, name + "/base", geometry::Cylinder{at.radius, 0.15}, Upright(at.centre, 0.15), looks.stone, 1.1);
}

void AddBench(World& world, const Looks& looks, const std::string& name, const Footprint& at, double yaw) {
  const Transform X_WN = Upright(at.centre, 0.0, yaw);  // x: where one looks
  const double half = 0.88 * at.radius;                 // leaves room for the depth of seat and back
  const auto part = [&](const char* what, const Vec3& centre, const Vec3& half_extents) {
    AddObject(world, name + "/" + what, geometry::Box{half_extents}, X_WN * Transform{base::Quat::Identity(), centre},
              looks.wood, 1.7);
  };
  part("seat", {0.0, 0.0, 0.43}, {0.2, half, 0.03});
  part("back", {-0.23, 0.0, 0.68}, {0.03, half, 0.22});
  part("left_leg", {0.0, 0.8 * half, 0.2}, {0.18, 0.04, 0.2});
  part("right_leg", {0.0, -0.8 * half, 0.2}, {0.18, 0.04, 0.2});
}

void AddGate(World& world, int material, const std::string& name, const GatePlan& plan) {
  const Transform X_WG = Upright(plan.p, plan.height, plan.yaw);
  const double side = 0.5 * (plan.opening + plan.frame);  // from mid-opening to the middle of a bar
  const double bar = 0.5 * plan.frame;
  const double below = plan.height - 0.5 * plan.opening - plan.frame;  // room under the frame
  const auto part = [&](const char* what, const Vec3& p_G, const Vec3& half_extents) {
    AddObject(world, name + "/" + what, geometry::Box{half_extents}, X_WG * Transform{base::Quat::Identity(), p_G},
              material, 1.3, SemanticClass::kGate);
  };
  part("left", {0.0, side, 0.0}, {bar, bar, side + bar});
  part("right", {0.0, -side, 0.0}, {bar, bar, side + bar});
  part("top", {0.0, 0.0, side}, {bar, side - bar, bar});
  part("bottom", {0.0, 0.0, -side}, {bar, side - bar, bar});
  // One post in the middle: two would make a second opening beneath the first.
  part("post", {0.0, 0.0, 0.5 * below - plan.height}, {0.8 * bar, 0.12, 0.5 * below});
  const double foot = std::min(0.03, 0.4 * below);
  part("foot", {0.0, 0.0, foot - plan.height}, {0.25, 0.4, foot});
  world.gates.push_back({name, X_WG, plan.opening, plan.frame});
}

void AddPad(World& world, int material, const Vec2& centre, double radius) {
  AddObject(world, "pad", geometry::Cylinder{radius, 0.5 * kPadHeight}, Upright(centre, 0.5 * kPadHeight), material,
            2.0 * radius, SemanticClass::kPad);
  world.pad_object = "pad";
  world.pad_radius = radius;
}

}  // namespace alula::worlds
