#include "worlds/kit/room.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

/// A tiled box between two corners in the axes of `X_WL`, without a shadow.
void AddSlab(World& world, const std::string& name, const Vec3& low, const Vec3& high, const Transform& X_WL,
             const Surface& surface, SemanticClass semantic, base::RandomStream& random) {
  const std::size_t first = world.objects.size();
  AddTiledBox(world, name, high - low, X_WL * Transform{base::Quat::Identity(), 0.5 * (low + high)}, surface, semantic,
              random);
  for (std::size_t i = first; i < world.objects.size(); ++i) world.objects[i].casts_shadow = false;
}

}  // namespace

Transform Standing(double x, double y, double z, double yaw) { return {base::FromYaw(yaw), {x, y, z}}; }

std::size_t AddBox(World& world, const std::string& name, const Vec3& size, const Transform& X_WO, int material,
                   double texture_scale, SemanticClass semantic) {
  world.objects.push_back({name, geometry::Box{0.5 * size}, X_WO, material, texture_scale, true, semantic});
  return world.objects.size() - 1;
}

void AddWall(World& world, const std::string& name, const WallConfig& config, const Transform& X_WL,
             const Surface& surface, base::RandomStream& random) {
  const double half = 0.5 * config.length;
  const double depth = 0.5 * config.thickness;
  std::vector<Opening> openings = config.openings;
  std::sort(openings.begin(), openings.end(), [](const Opening& a, const Opening& b) { return a.x_low < b.x_low; });
  const auto slab = [&](const std::string& part, double x0, double x1, double z0, double z1) {
    if (x1 - x0 < 1e-6 || z1 - z0 < 1e-6) return;
    AddSlab(world, name + "/" + part, {x0, -depth, z0}, {x1, depth, z1}, X_WL, surface, SemanticClass::kWall, random);
  };
  double x = -half;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const Opening& o = openings[i];
    if (o.x_low < x - 1e-9 || o.x_high > half + 1e-9 || o.x_high <= o.x_low || o.z_high > config.height) {
      throw base::FaultError("worlds", "an opening of " + name + " does not fit into it");
    }
    const std::string number = std::to_string(i);
    slab("beside" + number, x, o.x_low, 0.0, config.height);
    slab("under" + number, o.x_low, o.x_high, 0.0, o.z_low);
    slab("over" + number, o.x_low, o.x_high, o.z_high, config.height);
    x = o.x_high;
  }
  slab("rest", x, half, 0.0, config.height);
}

void AddShell(World& world, const ShellConfig& config, const Surface& floor, const Surface& wall,
              const Surface& ceiling, base::RandomStream& random) {
  const double t = config.thickness;
  const Vec3 h = 0.5 * config.size;
  AddSlab(world, "floor", {-h.x() - t, -h.y() - t, -t}, {h.x() + t, h.y() + t, 0.0}, {}, floor, SemanticClass::kGround,
          random);
  AddSlab(world, "ceiling", {-h.x() - t, -h.y() - t, config.size.z()}, {h.x() + t, h.y() + t, config.size.z() + t}, {},
          ceiling, SemanticClass::kWall, random);
  // Long walls end at the inner corner and the short ones close it, so that no two faces lie in one plane.
  const auto wall_at = [&](const char* name, const std::vector<Opening>& openings, double length, const Vec3& p,
                           double yaw) {
    AddWall(world, std::string("wall/") + name, {length, config.size.z(), t, openings}, {base::FromYaw(yaw), p}, wall,
            random);
  };
  wall_at("east", config.east, config.size.y() + 2.0 * t, {h.x() + 0.5 * t, 0.0, 0.0}, 0.5 * kPi);
  wall_at("north", config.north, config.size.x(), {0.0, h.y() + 0.5 * t, 0.0}, kPi);
  wall_at("west", config.west, config.size.y() + 2.0 * t, {-h.x() - 0.5 * t, 0.0, 0.0}, -0.5 * kPi);
  wall_at("south", config.south, config.size.x(), {0.0, -h.y() - 0.5 * t, 0.0}, 0.0);
}

void AddDoorFrame(World& world, const std::string& name, const Opening& clear, double jamb, double depth,
                  const Transform& X_WL, int material) {
  const double middle = 0.5 * (clear.x_low + clear.x_high);
  const double width = clear.x_high - clear.x_low;
  const auto part = [&](const char* what, const Vec3& size, const Vec3& p) {
    const std::size_t i = AddBox(world, name + "/" + what, size, X_WL * Transform{base::Quat::Identity(), p}, material,
                                 1.0, SemanticClass::kWall);
    world.objects[i].casts_shadow = false;
  };
  const double height = clear.z_high + jamb;
  part("left", {jamb, depth, height}, {clear.x_low - 0.5 * jamb, 0.0, 0.5 * height});
  part("right", {jamb, depth, height}, {clear.x_high + 0.5 * jamb, 0.0, 0.5 * height});
  part("head", {width, depth, jamb}, {middle, 0.0, clear.z_high + 0.5 * jamb});
}

}  // namespace alula::worlds
