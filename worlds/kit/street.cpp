#include "worlds/kit/street.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::Transform;
using base::Vec2;
using base::Vec3;
using geometry::Mesh;

constexpr double kPi = std::numbers::pi;

Transform At(double x, double y, double z) { return {Quat::Identity(), {x, y, z}}; }

void AddMesh(World& world, const std::string& name, std::shared_ptr<Mesh> mesh, const Transform& X, int material,
             SemanticClass semantic = SemanticClass::kObstacle) {
  AddObject(world, name, geometry::MeshShape{std::move(mesh)}, X, material, 1.0, semantic);
}

/// A capsule from a to b.
void AddLimb(World& world, int material, const std::string& name, const Transform& X, const Vec3& a, const Vec3& b,
             double radius) {
  const Quat q = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3(b - a));
  AddObject(world, name, geometry::Capsule{radius, 0.5 * (b - a).norm()}, X * Transform{q, 0.5 * (a + b)}, material,
            1.2);
}

}  // namespace

void AddStreetLamp(World& world, int metal, const std::string& name, const Transform& X_WL,
                   const StreetLampConfig& config, bool lit) {
  const double h = config.height;
  AddObject(world, name + "/base", geometry::Cylinder{0.11, 0.45}, X_WL * At(0, 0, 0.35), metal, 0.6);
  AddObject(world, name + "/mast", geometry::Cylinder{0.055, 0.5 * h}, X_WL * At(0, 0, 0.5 * h), metal, 0.6);
  auto arm = std::make_shared<Mesh>();
  const std::array<TubePoint, 4> line{{{{0.0, 0.0, h - 0.05}, 0.04},
                                       {{0.25 * config.arm, 0.0, h + 0.22}, 0.035},
                                       {{0.6 * config.arm, 0.0, h + 0.32}, 0.03},
                                       {{config.arm, 0.0, h + 0.30}, 0.03}}};
  AddTube(*arm, line, 6, 0.6);
  AddMesh(world, name + "/arm", std::move(arm), X_WL, metal);
  AddObject(world, name + "/head", geometry::Box{{0.28, 0.11, 0.05}}, X_WL * At(config.arm + 0.15, 0, h + 0.28), metal,
            0.6);
  if (!lit) return;
  Lamp lamp;
  lamp.position = X_WL * Vec3(config.arm + 0.15, 0.0, h + 0.2);
  lamp.direction = -Vec3::UnitZ();
  lamp.cone = 78.0 / 180.0 * kPi;
  lamp.softness = 0.5;
  lamp.intensity = config.intensity;
  lamp.range = config.range;
  lamp.colour = {1.0, 0.82, 0.58};  // sodium and warm LED light
  world.light.lamps.push_back(lamp);
}

CarLooks AddCarLooks(World& world, const std::string& name, const Eigen::Vector3f& paint) {
  CarLooks looks;
  looks.paint = AddMaterial(world, name + "/paint",
                            {.pattern = Pattern::kPaint, .palette = {0.5F * paint, paint}, .size = 64}, 1);
  looks.glass = AddPlainMaterial(world, name + "/glass", {0.10F, 0.12F, 0.14F});
  looks.tyre = AddPlainMaterial(world, name + "/tyre", {0.07F, 0.07F, 0.07F});
  return looks;
}

void AddCar(World& world, const CarLooks& looks, const std::string& name, const Transform& X_WC) {
  constexpr double kWidth = 1.75;
  const std::array<Vec2, 8> lower{{{-2.10, 0.28},
                                   {2.05, 0.26},
                                   {2.15, 0.45},
                                   {2.10, 0.68},
                                   {1.05, 0.88},
                                   {-1.95, 0.92},
                                   {-2.15, 0.80},
                                   {-2.17, 0.45}}};
  auto body = std::make_shared<Mesh>();
  AddPrism(*body, lower, kWidth, Transform{}, 2.0);
  AddMesh(world, name + "/body", std::move(body), X_WC, looks.paint);
  // The cabin's glass, and the roof on it; pillars are where the roof comes down.
  const std::array<Vec2, 4> cabin{{{-1.75, 0.88}, {1.02, 0.86}, {0.30, 1.36}, {-1.25, 1.38}}};
  auto glass = std::make_shared<Mesh>();
  AddPrism(*glass, cabin, kWidth - 0.22, Transform{}, 2.0);
  AddMesh(world, name + "/windows", std::move(glass), X_WC, looks.glass);
  auto roof = std::make_shared<Mesh>();
  AddPrism(*roof, std::array<Vec2, 4>{{{-1.32, 1.36}, {0.36, 1.34}, {0.22, 1.43}, {-1.15, 1.45}}}, kWidth - 0.2,
           Transform{}, 2.0);
  for (const double y : {-0.5 * kWidth + 0.13, 0.5 * kWidth - 0.13}) {
    AddBeam(*roof, {0.98, y, 0.86}, {0.30, y, 1.38}, 0.07, 0.07, 2.0);
    AddBeam(*roof, {-0.45, y, 0.90}, {-0.45, y, 1.38}, 0.06, 0.09, 2.0);
    AddBeam(*roof, {-1.74, y, 0.90}, {-1.25, y, 1.38}, 0.08, 0.12, 2.0);
  }
  AddMesh(world, name + "/roof", std::move(roof), X_WC, looks.paint);
  int wheel = 0;
  for (const double x : {-1.32, 1.32}) {
    for (const double y : {-0.5 * kWidth + 0.10, 0.5 * kWidth - 0.10}) {
      AddObject(world, name + "/wheel" + std::to_string(wheel++), geometry::Cylinder{0.31, 0.11},
                X_WC * Transform{base::FromYawPitchRoll(0.0, 0.0, 0.5 * kPi), {x, y, 0.31}}, looks.tyre, 0.5);
    }
  }
}

void AddFence(World& world, int wood, const std::string& name, const std::vector<Vec3>& line, double height) {
  auto mesh = std::make_shared<Mesh>();
  for (std::size_t i = 0; i < line.size(); ++i) {
    AddBoxPart(*mesh, {0.10, 0.10, height + 0.5}, {Quat::Identity(), line[i] + Vec3(0, 0, 0.5 * (height - 0.5) + 0.06)},
               0.8);
    if (i + 1 == line.size()) break;
    for (const double share : {0.45, 0.9}) {
      const Vec3 up(0, 0, share * height);
      AddBeam(*mesh, line[i] + up, line[i + 1] + up, 0.035, 0.11, 0.8);
    }
  }
  AddMesh(world, name, std::move(mesh), Transform{}, wood);
}

void AddStoneBench(World& world, int stone, const std::string& name, const Transform& X_WB, double length) {
  AddObject(world, name + "/slab", geometry::Box{{0.5 * length, 0.25, 0.06}}, X_WB * At(0, 0, 0.39), stone, 1.2);
  for (const double side : {-1.0, 1.0}) {
    AddObject(world, name + (side < 0 ? "/left" : "/right"), geometry::Box{{0.14, 0.20, 0.24}},
              X_WB * At(0.38 * side * length, 0, 0.09), stone, 1.2);
  }
}

void AddCarvedWall(World& world, int stone, int carving, const std::string& name, const Transform& X_WV, double length,
                   double height, base::RandomStream& random) {
  const double half = 0.5 * length;
  AddObject(world, name + "/plinth", geometry::Box{{half + 0.15, 0.38, 0.25}}, X_WV * At(0, 0, 0.05), stone, 1.5);
  AddObject(world, name + "/wall", geometry::Box{{half, 0.22, 0.5 * height}}, X_WV * At(0, 0, 0.5 * height), carving,
            1.5);
  AddObject(world, name + "/coping", geometry::Box{{half + 0.1, 0.32, 0.08}}, X_WV * At(0, 0, height + 0.08), stone,
            1.5);
  auto relief = std::make_shared<Mesh>();
  const int panels = std::max(2, static_cast<int>(length / 0.9));
  const double width = length / panels;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < panels; ++i) {
      const Vec3 middle(-half + (i + 0.5) * width, side * 0.22, 0.55 * height + 0.1);
      AddBoxPart(*relief, {0.84 * width, 0.06, 0.62 * height}, {Quat::Identity(), middle}, 1.5);
      for (int k = 0; k < 5; ++k) {  // bosses, as figures worn by rain
        const Vec3 at = middle + Vec3(random.Uniform(-0.3, 0.3) * width, 0.0, random.Uniform(-0.24, 0.24) * height);
        const double r = random.Uniform(0.06, 0.15) * std::min(1.0, width);
        const std::array<Vec2, 5> profile{
            {{r, 0.0}, {0.92 * r, 0.35 * r}, {0.7 * r, 0.65 * r}, {0.4 * r, 0.85 * r}, {0.0, 0.92 * r}}};
        const Quat q = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3(0.0, side, 0.0));
        AddLathe(*relief, profile, 10, {q, at + Vec3(0.0, 0.025 * side, 0.0)}, 1.5);
      }
    }
  }
  AddMesh(world, name + "/relief", std::move(relief), X_WV, carving);
}

void AddSculpture(World& world, int stone, const std::string& name, const Transform& X_WS, double height) {
  const double plinth = 0.28 * height;
  AddObject(world, name + "/step", geometry::Box{{0.30 * height, 0.30 * height, 0.5}}, X_WS * At(0, 0, -0.38), stone,
            1.5);
  AddObject(world, name + "/plinth", geometry::Box{{0.20 * height, 0.20 * height, 0.5 * plinth}},
            X_WS * At(0, 0, 0.5 * plinth), stone, 1.5);
  const double s = (height - plinth) / 1.8;  // of a figure 1.8 m tall
  const Transform X = X_WS * At(0, 0, plinth);
  const auto limb = [&](const char* part, const Vec3& a, const Vec3& b, double radius) {
    AddLimb(world, stone, name + "/" + part, X, s * a, s * b, s * radius);
  };
  limb("left_leg", {0.05, 0.12, 0.08}, {0.0, 0.10, 0.88}, 0.095);
  limb("right_leg", {-0.10, -0.13, 0.08}, {0.0, -0.10, 0.88}, 0.095);
  limb("torso", {0.0, 0.0, 0.95}, {0.02, 0.0, 1.36}, 0.185);
  limb("left_arm", {0.0, 0.24, 1.42}, {0.06, 0.30, 1.12}, 0.06);
  limb("left_forearm", {0.06, 0.30, 1.12}, {0.28, 0.22, 1.02}, 0.05);
  limb("right_arm", {0.0, -0.24, 1.42}, {0.18, -0.34, 1.56}, 0.06);
  limb("right_forearm", {0.18, -0.34, 1.56}, {0.36, -0.32, 1.80}, 0.05);
  limb("neck", {0.0, 0.0, 1.45}, {0.02, 0.0, 1.56}, 0.065);
  AddObject(world, name + "/head", geometry::Sphere{0.125 * s}, X * At(0.03 * s, 0, 1.68 * s), stone, 1.2);
  AddObject(world, name + "/cloak", geometry::Cone{0.30 * s, 0.62 * s}, X * At(-0.06 * s, 0, 0.62 * s), stone, 1.2);
}

}  // namespace alula::worlds
