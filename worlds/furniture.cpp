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
