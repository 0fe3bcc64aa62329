#include "worlds/kit/pylon.h"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "worlds/furniture.h"
#include "worlds/kit/mesh_parts.h"

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;
using geometry::Mesh;

constexpr double kWaist = 0.62;  // share of the height where the legs meet the body
constexpr double kLeg = 0.11;    // m, side of an angle section as seen
constexpr double kBrace = 0.06;  // m
constexpr double kArms[3] = {0.66, 0.77, 0.88};
constexpr double kSides[3] = {1.0, -1.0, 1.0};

/// Half side of the tower's square section at a height.
double HalfAt(const PylonConfig& c, double z) {
  const double waist = kWaist * c.height;
  const double body = 0.45;  // m, half side of the body
  return z < waist ? 0.5 * c.base + (body - 0.5 * c.base) * z / waist
                   : body * (1.0 - 0.75 * (z - waist) / (c.height - waist));
}

Vec3 Corner(const PylonConfig& c, int k, double z) {
  const double half = HalfAt(c, z);
  return {k == 0 || k == 3 ? half : -half, k < 2 ? half : -half, z};
}

/// Legs and crossed braces between heights, in `panels` that grow shorter upwards as the tower narrows.
void AddPanels(Mesh& mesh, const PylonConfig& c, double from, double to, int panels) {
  for (int i = 0; i < panels; ++i) {
    const double z0 = from + (to - from) * std::pow(static_cast<double>(i) / panels, 0.85);
    const double z1 = from + (to - from) * std::pow((i + 1.0) / panels, 0.85);
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      AddBeam(mesh, Corner(c, k, z0), Corner(c, k, z1), kLeg, kLeg, 1.0);
      AddBeam(mesh, Corner(c, k, z0), Corner(c, next, z1), kBrace, kBrace, 1.0);
      AddBeam(mesh, Corner(c, next, z0), Corner(c, k, z1), kBrace, kBrace, 1.0);
      AddBeam(mesh, Corner(c, k, z1), Corner(c, next, z1), kBrace, kBrace, 1.0);
    }
  }
}

void AddArm(Mesh& mesh, const PylonConfig& c, double z, double side) {
  const Vec3 tip(0.0, side * c.arm, z);
  const double half = HalfAt(c, z);
  const double up = 0.06 * c.height;
  for (const double x : {-1.0, 1.0}) {
    const Vec3 low(x * half, side * half, z);
    const Vec3 high(x * HalfAt(c, z + up), side * HalfAt(c, z + up), z + up);
    AddBeam(mesh, low, tip, 0.08, 0.08, 1.0);
    AddBeam(mesh, high, tip, kBrace, kBrace, 1.0);
    for (const double share : {0.35, 0.68}) {
      AddBeam(mesh, Vec3(low + share * (tip - low)), Vec3(high + share * (tip - high)), 0.045, 0.045, 1.0);
    }
  }
  for (const double share : {0.35, 0.68}) {
    const Vec3 middle = Vec3(0.0, side * half, z) + share * (tip - Vec3(0.0, side * half, z));
    const double wide = half * (1.0 - share);
    AddBeam(mesh, middle - Vec3(wide, 0, 0), middle + Vec3(wide, 0, 0), 0.045, 0.045, 1.0);
  }
}

}  // namespace

std::vector<Vec3> ArmTips(const PylonConfig& c) {
  std::vector<Vec3> tips;
  for (int i = 0; i < 3; ++i) tips.emplace_back(0.0, kSides[i] * (c.arm - 0.08), kArms[i] * c.height);
  return tips;
}

Vec3 PeakOf(const PylonConfig& c) { return {0.0, 0.0, c.height}; }

void AddPylon(World& world, int steel, int concrete, const std::string& name, const Transform& X_WP,
              const PylonConfig& config) {
  const auto put = [&](const char* part, std::shared_ptr<Mesh> mesh) {
    AddObject(world, name + "/" + part, geometry::MeshShape{std::move(mesh)}, X_WP, steel, 1.0);
  };
  auto lower = std::make_shared<Mesh>();
  AddPanels(*lower, config, -0.2, kWaist * config.height, 5);
  put("lower", std::move(lower));
  auto upper = std::make_shared<Mesh>();
  AddPanels(*upper, config, kWaist * config.height, 0.985 * config.height, 6);
  AddBeam(*upper, {0.0, 0.0, 0.96 * config.height}, {0.0, 0.0, config.height + 0.05}, 0.1, 0.1, 1.0);
  put("upper", std::move(upper));
  auto arms = std::make_shared<Mesh>();
  for (int i = 0; i < 3; ++i) AddArm(*arms, config, kArms[i] * config.height, kSides[i]);
  put("arms", std::move(arms));
  for (int k = 0; k < 4; ++k) {
    const Vec3 foot = Corner(config, k, 0.0);
    AddObject(world, name + "/footing" + std::to_string(k), geometry::Box{{0.3, 0.3, 0.5}},
              X_WP * Transform{base::Quat::Identity(), foot - Vec3(0, 0, 0.3)}, concrete, 1.2);
  }
}

void AddInsulator(World& world, int ceramic, const std::string& name, const Vec3& top, double length) {
  constexpr double kCap = 0.146;  // m, of one cap-and-pin unit (U70)
  const int caps = std::max(2, static_cast<int>((length - 0.12) / kCap));
  std::vector<Vec2> profile;
  profile.emplace_back(0.0, -length);
  profile.emplace_back(0.02, -length);
  for (int i = caps - 1; i >= 0; --i) {
    const double z = -0.06 - kCap * (i + 1);
    profile.emplace_back(0.022, z);
    profile.emplace_back(0.127, z + 0.02);
    profile.emplace_back(0.115, z + 0.045);
    profile.emplace_back(0.05, z + 0.075);
    profile.emplace_back(0.045, z + 0.125);
  }
  profile.emplace_back(0.02, -0.05);
  profile.emplace_back(0.02, 0.02);
  profile.emplace_back(0.0, 0.02);
  auto mesh = std::make_shared<Mesh>();
  AddLathe(*mesh, profile, 10, Transform{}, 0.5);
  AddObject(world, name, geometry::MeshShape{std::move(mesh)}, {base::Quat::Identity(), top}, ceramic, 1.0);
}

}  // namespace alula::worlds
