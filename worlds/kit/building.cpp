#include "worlds/kit/building.h"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"

namespace alula::worlds {
namespace {

using base::Quat;
using base::Transform;
using base::Vec2;
using base::Vec3;
using geometry::Mesh;

constexpr double kFooting = 0.8;  // m of wall below the foot

/// Windows of one face: frames, panes and sills as meshes of their own.
struct Glazing {
  std::shared_ptr<Mesh> frames = std::make_shared<Mesh>();
  std::shared_ptr<Mesh> panes = std::make_shared<Mesh>();
  std::shared_ptr<Mesh> stone = std::make_shared<Mesh>();

  /// X: middle of the opening on the wall's face, z up, y out of it.
  void Add(const Transform& X, double width, double height) {
    constexpr double kBar = 0.07;
    const auto bar = [&](double x, double z, double w, double h) {
      AddBoxPart(*frames, {w, 0.08, h}, X * Transform{Quat::Identity(), {x, 0.0, z}}, 1.0);
    };
    bar(-0.5 * width, 0.0, kBar, height + kBar);
    bar(0.5 * width, 0.0, kBar, height + kBar);
    bar(0.0, 0.5 * height, width - kBar, kBar);
    bar(0.0, -0.5 * height, width - kBar, kBar);
    bar(0.0, 0.0, 0.05, height - kBar);
    // One face, well before the wall: thin boxes lose their depth at coarse levels of detail.
    const double x = 0.5 * (width - kBar);
    const double z = 0.5 * (height - kBar);
    const auto corner = [&](double side, double up) { return X * Vec3(side * x, 0.02, up * z); };
    AddQuad(*panes, {corner(1, -1), corner(-1, -1), corner(-1, 1), corner(1, 1)}, 1.0);
    AddBoxPart(*stone, {width + 0.25, 0.26, 0.07}, X * Transform{Quat::Identity(), {0.0, 0.02, -0.5 * height - 0.08}},
               1.0);
  }

  void AddTo(World& world, const BuildingLooks& looks, const std::string& name, const Transform& X) && {
    const auto put = [&](const char* part, std::shared_ptr<Mesh> mesh, int material, SemanticClass semantic) {
      if (mesh->triangles.empty()) return;
      AddObject(world, name + "/" + part, geometry::MeshShape{std::move(mesh)}, X, material, 1.0, semantic);
    };
    put("frames", std::move(frames), looks.frame, SemanticClass::kWall);
    put("panes", std::move(panes), looks.glass, SemanticClass::kGlass);
    put("sills", std::move(stone), looks.stone, SemanticClass::kWall);
  }
};

/// The face that looks along `side` of axis 0 (x) or 1 (y): a pose with y out of it, at height z and `along` it.
Transform OnFace(int axis, double side, const Vec2& half, double along, double z) {
  const double yaw = axis == 1 ? (side > 0 ? 0.0 : M_PI) : (side > 0 ? -0.5 * M_PI : 0.5 * M_PI);
  const Quat q = base::FromYaw(yaw);
  const double out = axis == 1 ? half.y() : half.x();
  return Transform{q, q * Vec3(along, out, z)};
}

}  // namespace

BuildingLooks AddBuildingLooks(World& world, Pattern wall, const Palette& colours, const std::string& name,
                               std::uint64_t seed) {
  BuildingLooks looks;
  looks.wall = AddSurface(
      world, name + "/wall",
      {.pattern = wall, .palette = colours, .period = 3.0, .size = 512, .variants = 2, .contrast = 0.13}, seed);
  looks.roof = AddMaterial(world, name + "/roof",
                           {.pattern = Pattern::kBrick,
                            .palette = {{0.26F, 0.13F, 0.10F}, {0.62F, 0.38F, 0.30F}},
                            .size = 512,
                            .contrast = 0.16},
                           seed);
  looks.frame = AddPlainMaterial(world, name + "/frame", {0.82F, 0.81F, 0.77F});
  looks.glass = AddPlainMaterial(world, name + "/glass", {0.17F, 0.21F, 0.25F});
  looks.door = AddMaterial(world, name + "/door",
                           {.pattern = Pattern::kWood,
                            .palette = {{0.14F, 0.09F, 0.05F}, {0.45F, 0.30F, 0.18F}},
                            .size = 128,
                            .contrast = 0.2},
                           seed);
  looks.stone = AddMaterial(world, name + "/stone",
                            {.pattern = Pattern::kPlaster,
                             .palette = {{0.35F, 0.34F, 0.32F}, {0.72F, 0.70F, 0.66F}},
                             .size = 128,
                             .contrast = 0.13},
                            seed);
  return looks;
}

void AddHouse(World& world, const BuildingLooks& looks, const std::string& name, const Transform& X_WH,
              const HouseConfig& config, base::RandomStream& random) {
  const Vec3& size = config.size;
  AddTiledBox(world, name + "/walls", {size.x(), size.y(), size.z() + kFooting},
              X_WH * Transform{Quat::Identity(), {0, 0, 0.5 * (size.z() - kFooting)}}, looks.wall, SemanticClass::kWall,
              random);
  // Gables under the roof, and the roof's two slopes, each a slab with eaves.
  auto gables = std::make_shared<Mesh>();
  const double half = 0.5 * size.y();
  AddPrism(*gables, std::array<Vec2, 3>{{{-half, 0.0}, {half, 0.0}, {0.0, config.roof}}}, size.x() - 0.02,
           {base::FromYaw(0.5 * M_PI), {0, 0, size.z()}}, looks.wall.period);
  AddObject(world, name + "/gables", geometry::MeshShape{std::move(gables)}, X_WH, looks.wall.variants.front(), 1.0,
            SemanticClass::kWall);
  const double pitch = std::atan2(config.roof, half);
  const double slope = std::hypot(config.roof, half) + 0.45;
  for (const double side : {-1.0, 1.0}) {
    const Quat q = base::FromYawPitchRoll(0.0, 0.0, -side * pitch);
    const Vec3 ridge(0.0, 0.0, size.z() + config.roof + 0.05);
    const Vec3 down = q * Vec3(0.0, side, 0.0);
    AddObject(world, name + (side < 0 ? "/roof_south" : "/roof_north"),
              geometry::Box{{0.5 * size.x() + 0.35, 0.5 * slope, 0.06}},
              X_WH * Transform{q, ridge + 0.5 * slope * down}, looks.roof, 3.0, SemanticClass::kWall);
  }
  AddObject(world, name + "/chimney", geometry::Box{{0.35, 0.28, 0.9}},
            X_WH * Transform{Quat::Identity(), {0.27 * size.x(), 0.22 * size.y(), size.z() + config.roof + 0.05}},
            looks.wall.variants.front(), 3.0, SemanticClass::kWall);

  Glazing glazing;
  const Vec2 extent(0.5 * size.x(), half);
  const double z = 0.55 * size.z();
  const int along = std::max(2, static_cast<int>(size.x() / 2.6));
  for (int i = 0; i < along; ++i) {
    const double x = size.x() * ((i + 0.5) / along - 0.5);
    glazing.Add(OnFace(1, 1.0, extent, x, z), 1.1, 1.3);
    if (i != along / 2) glazing.Add(OnFace(1, -1.0, extent, -x, z), 1.1, 1.3);
  }
  for (const double side : {-1.0, 1.0}) {
    glazing.Add(OnFace(0, side, extent, 0.2 * size.y(), z), 0.9, 1.3);
    glazing.Add(OnFace(0, side, extent, -0.2 * size.y(), z), 0.9, 1.3);
  }
  std::move(glazing).AddTo(world, looks, name, X_WH);
  const double door = size.x() * ((along / 2 + 0.5) / along - 0.5);
  const Transform X_HD = OnFace(1, -1.0, extent, -door, 0.0);
  AddObject(world, name + "/door", geometry::Box{{0.5, 0.06, 1.05}},
            X_WH * X_HD * Transform{Quat::Identity(), {0, 0, 1.05}}, looks.door, 1.2);
  AddObject(world, name + "/doorstep", geometry::Box{{0.8, 0.45, 0.4}},
            X_WH * X_HD * Transform{Quat::Identity(), {0, 0.4, -0.3}}, looks.stone, 1.2);
}

void AddBlock(World& world, const BuildingLooks& looks, const std::string& name, const Transform& X_WB,
              const BlockConfig& config, base::RandomStream& random) {
  const double height = config.storeys * config.storey + 0.4;
  const Vec2 half(0.5 * config.length, 0.5 * config.width);
  AddTiledBox(world, name + "/walls", {config.length, config.width, height + kFooting},
              X_WB * Transform{Quat::Identity(), {0, 0, 0.5 * (height - kFooting)}}, looks.wall, SemanticClass::kWall,
              random);
  auto stone = std::make_shared<Mesh>();
  const auto band = [&](double z, double h, double out) {  // around the house: four beams
    for (const double side : {-1.0, 1.0}) {
      AddBoxPart(*stone, {config.length + 2.0 * out, 0.3, h},
                 {Quat::Identity(), {0, side * (half.y() + out - 0.15), z}}, 1.5);
      AddBoxPart(*stone, {0.3, config.width + 2.0 * out - 0.6, h},
                 {Quat::Identity(), {side * (half.x() + out - 0.15), 0, z}}, 1.5);
    }
  };
  band(height + 0.3, 0.7, 0.08);
  band(0.25, 0.5, 0.06);
  AddObject(world, name + "/bands", geometry::MeshShape{std::move(stone)}, X_WB, looks.stone, 1.0,
            SemanticClass::kWall);
  Glazing glazing;
  for (int storey = 0; storey < config.storeys; ++storey) {
    const double z = 0.5 + (storey + 0.5) * config.storey;
    for (const int axis : {0, 1}) {
      const double length = axis == 1 ? config.length : config.width;
      const int count = std::max(2, static_cast<int>(length / 2.7));
      for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < count; ++i) {
          const double at = length * ((i + 0.5) / count - 0.5);
          if (storey == 0 && axis == 1 && side < 0 && i == count / 2) continue;  // the door
          glazing.Add(OnFace(axis, side, half, at, z), 1.25, 1.55);
        }
      }
    }
  }
  std::move(glazing).AddTo(world, looks, name, X_WB);
  const int count = std::max(2, static_cast<int>(config.length / 2.7));
  const Transform X_BD = OnFace(1, -1.0, half, config.length * ((count / 2 + 0.5) / count - 0.5), 0.0);
  AddObject(world, name + "/door", geometry::Box{{0.8, 0.08, 1.2}},
            X_WB * X_BD * Transform{Quat::Identity(), {0, 0, 1.2}}, looks.door, 1.2);
}

}  // namespace alula::worlds
