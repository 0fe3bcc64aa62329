#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "worlds/check_start.h"
#include "worlds/kit/catenary.h"
#include "worlds/kit/land.h"
#include "worlds/kit/mesh_parts.h"
#include "worlds/outdoor/forest.h"
#include "worlds/outdoor/landing_town.h"
#include "worlds/outdoor/landing_woods.h"
#include "worlds/outdoor/open_field.h"
#include "worlds/outdoor/powerline.h"
#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

TEST(Catenary, HangsBetweenItsEndsByTheLawOfTheChain) {
  for (const double rise : {0.0, 6.0, -11.0}) {
    const Vec3 from(1.0, 2.0, 20.0);
    const Vec3 to(41.0, 32.0, 20.0 + rise);  // 50 m apart
    constexpr double kA = 90.0;
    const Catenary line(from, to, kA);
    EXPECT_LT((line.At(0.0) - from).norm(), 1e-12);
    EXPECT_LT((line.At(1.0) - to).norm(), 1e-10);
    // a z'' = √(1 + z'²); central differences over 0.5 m err by h² z''''/12 < 1e-6.
    constexpr double kStep = 0.01;
    double length = 0.0;
    double sag = 0.0;
    for (double s = kStep; s < 1.0 - 0.5 * kStep; s += kStep) {
      const double h = 50.0 * kStep;
      const double before = line.At(s - kStep).z();
      const double here = line.At(s).z();
      const double after = line.At(s + kStep).z();
      const double slope = (after - before) / (2.0 * h);
      EXPECT_NEAR(kA * (after - 2.0 * here + before) / (h * h), std::sqrt(1.0 + slope * slope), 1e-3);
      sag = std::max(sag, 20.0 + rise * s - here);
    }
    for (int i = 0; i < 10'000; ++i) length += (line.At((i + 1) / 1e4) - line.At(i / 1e4)).norm();
    EXPECT_NEAR(line.Length(), length, 1e-6);
    EXPECT_NEAR(line.Sag(), sag, 1e-3);
  }
  // Level: sag = a (cosh(L / 2a) − 1).
  EXPECT_NEAR(Catenary({0, 0, 0}, {66, 0, 0}, 663.0).Sag(), 663.0 * (std::cosh(33.0 / 663.0) - 1.0), 1e-9);
}

double SignedVolume(const geometry::Mesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return Vec3(mesh.vertices[t[i]].position.cast<double>()); };
    volume += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return volume;
}

TEST(MeshParts, AreClosedAndLookOutwards) {
  const base::Transform X{base::FromYawPitchRoll(0.3, -0.4, 1.0), {3.0, -2.0, 1.0}};
  geometry::Mesh box;
  AddBoxPart(box, {2.0, 0.5, 0.25}, X, 1.0);
  EXPECT_NEAR(SignedVolume(box), 0.25, 1e-5);
  geometry::Mesh beam;
  AddBeam(beam, {0, 0, 0}, {3, 4, 12}, 0.1, 0.2, 1.0);
  EXPECT_NEAR(SignedVolume(beam), 13.0 * 0.02, 1e-5);
  geometry::Mesh prism;
  AddPrism(prism, std::array<Vec2, 3>{{{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}}}, 3.0, X, 1.0);
  EXPECT_NEAR(SignedVolume(prism), 3.0, 1e-5);
  geometry::Mesh tube;
  AddTube(tube, std::array<TubePoint, 3>{{{{0, 0, 0}, 0.5}, {{0, 0, 1}, 0.5}, {{0, 0, 2}, 0.5}}}, 8, 1.0);
  EXPECT_NEAR(SignedVolume(tube), 2.0 * 8.0 * 0.5 * 0.25 * std::sin(std::numbers::pi / 4.0), 1e-5);
  geometry::Mesh turned;  // a frustum of 24 sides, closed on its axis
  AddLathe(turned, std::array<Vec2, 4>{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {0.0, 2.0}}}, 24, X, 1.0);
  EXPECT_NEAR(SignedVolume(turned), 2.0 * 24.0 * 0.5 * std::sin(std::numbers::pi / 12.0), 1e-4);
  base::RandomStream random(1, "test/boulder");
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.5 * 0.4 * 0.3;
  const double stone = SignedVolume(*MakeBoulder({0.5, 0.4, 0.3}, 0.05, 1.0, random));
  EXPECT_GT(stone, 0.5 * ball);
  EXPECT_LT(stone, 1.1 * ball);
}

TEST(Land, JoinsTheFieldPointByPoint) {
  base::RandomStream random(3, "test/land");
  World world;
  world.materials.resize(1);
  const Land land = MakeLand({.half = {16.0, 24.0}, .cell = 1.0, .reach = 48.0}, {}, random);
  AddLand(world, land, {{0}, 4.0}, {{0}, 8.0}, random);
  std::map<std::pair<float, float>, float> border;  // of the field
  int joined = 0;
  for (const Object& object : world.objects) {
    const bool field = object.name.starts_with("ground/");
    for (const auto& vertex : std::get<geometry::MeshShape>(object.shape).mesh->vertices) {
      const Eigen::Vector3f& p = vertex.position;
      const bool on_border = std::abs(p.x()) <= 16.0F && std::abs(p.y()) <= 24.0F &&
                             (std::abs(p.x()) == 16.0F || std::abs(p.y()) == 24.0F);
      if (!on_border) continue;
      if (field) border[{p.x(), p.y()}] = p.z();
      if (field) continue;
      const auto found = border.find({p.x(), p.y()});
      ASSERT_NE(found, border.end());  // the field's tiles come first
      EXPECT_EQ(found->second, p.z());
      ++joined;
    }
    for (const auto& t : std::get<geometry::MeshShape>(object.shape).mesh->triangles) {
      const auto& v = std::get<geometry::MeshShape>(object.shape).mesh->vertices;
      EXPECT_GT((v[t[1]].position - v[t[0]].position).cross(v[t[2]].position - v[t[0]].position).z(), 0.0F);
    }
  }
  EXPECT_GE(joined, 2 * (32 + 48));  // every point of the border is met from outside
}

/// The outdoor worlds as the catalog has them, with the weather given.
std::map<std::string, std::function<World(std::uint64_t, WeatherConfig::Hour)>> OutdoorWorlds() {
  const auto make = [](auto config) {
    return [config](std::uint64_t seed, WeatherConfig::Hour hour) {
      auto own = config;
      own.weather.hour = hour;
      return MakeWorld(own, seed);
    };
  };
  return {{"forest", make(ForestConfig{})},
          {"open_field", make(OpenFieldConfig{})},
          {"landing_forest", make(LandingForestConfig{})},
          {"landing_slope", make(LandingSlopeConfig{})},
          {"landing_field", make(LandingFieldConfig{})},
          {"landing_square", make(LandingSquareConfig{})},
          {"landing_flowerbeds", make(LandingFlowerbedsConfig{})},
          {"powerline", make(PowerlineConfig{})}};
}

std::uint64_t Digest(const World& world) {
  base::RollingHash hash;
  AddTo(hash, world);
  return hash.value();
}

TEST(Outdoor, SameSeedSameWorldAndAnotherSeedAnother) {
  for (const auto& [name, make] : OutdoorWorlds()) {
    SCOPED_TRACE(name);
    const std::uint64_t first = Digest(make(1, WeatherConfig::Hour::kDay));
    EXPECT_EQ(first, Digest(make(1, WeatherConfig::Hour::kDay)));
    EXPECT_NE(first, Digest(make(2, WeatherConfig::Hour::kDay)));
  }
}

TEST(Outdoor, WorldsAreSound) {
  for (const auto& [name, make] : OutdoorWorlds()) {
    SCOPED_TRACE(name);
    const World world = make(7, WeatherConfig::Hour::kDay);
    EXPECT_EQ(world.name, name);
    EXPECT_NO_THROW(CheckStart(world));
    EXPECT_LT(world.objects.size(), 2000U);  // clearance is asked at each step
    std::set<std::string> names;
    for (const Object& object : world.objects) {
      EXPECT_TRUE(names.insert(object.name).second) << object.name;
      ASSERT_GE(object.material, 0);
      ASSERT_LT(static_cast<std::size_t>(object.material), world.materials.size());
      const geometry::Material& material = world.materials[static_cast<std::size_t>(object.material)];
      EXPECT_EQ(object.collides, !geometry::HasHoles(material)) << object.name;
    }
    for (const Vec3& p : {world.X_WB_start.p, world.target}) {
      EXPECT_TRUE((p.array() >= world.bounds_low.array()).all() && (p.array() <= world.bounds_high.array()).all());
    }
    EXPECT_TRUE(names.count(world.pad_object) == 1);
  }
}

TEST(Outdoor, LampsBurnInTownAtNightAndNotByDay) {
  for (const auto& [name, make] : OutdoorWorlds()) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(make(1, WeatherConfig::Hour::kDay).light.lamps.empty());
    const World night = make(1, WeatherConfig::Hour::kNight);
    const bool has_lamps =
        name == "landing_square" || name == "landing_flowerbeds" || name == "powerline" || name == "open_field";
    EXPECT_EQ(!night.light.lamps.empty(), has_lamps);
    EXPECT_LT(night.light.ambient, 0.01F);
  }
}

/// Horizontal distance of the conductors' middles below the chord is the catenary's; what hangs on the line touches it.
TEST(Powerline, ThingsHangOnTheLine) {
  const World world = MakeWorld(PowerlineConfig{}, 3);
  std::vector<Vec3> wire;  // points of the conductors' skins
  for (const Object& object : world.objects) {
    if (!object.name.starts_with("conductor")) continue;
    for (const auto& v : std::get<geometry::MeshShape>(object.shape).mesh->vertices)
      wire.push_back(v.position.cast<double>());
  }
  ASSERT_FALSE(wire.empty());
  for (const char* thing : {"kite0/spars", "balloon0/string", "bag0/film", "branch0/wood"}) {
    SCOPED_TRACE(thing);
    bool found = false;
    for (const Object& object : world.objects) {
      if (object.name != thing) continue;
      found = true;
      double nearest = 1e9;
      for (const auto& v : std::get<geometry::MeshShape>(object.shape).mesh->vertices) {
        const Vec3 p = object.X_WO * Vec3(v.position.cast<double>());
        for (const Vec3& q : wire) nearest = std::min(nearest, (p - q).norm());
      }
      EXPECT_LT(nearest, 1.2);  // points of the wire lie 1.65 m apart along it
    }
    EXPECT_TRUE(found);
  }
}

TEST(CheckStart, SaysWhatIsMissing) {
  const auto complaint = [](const World& world) {
    try {
      CheckStart(world);
    } catch (const base::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  World world;
  world.materials.resize(1);
  world.pad_object = "pad";
  world.X_WB_start.p = {1.0, 2.0, 0.0};
  EXPECT_NE(complaint(world).find("no ground under the start at (1.00, 2.00, 0.00) m"), std::string::npos);
  world.objects.push_back({"ground", geometry::Box{{5, 5, 0.5}}, {base::Quat::Identity(), {0, 0, -0.5}}, 0});
  EXPECT_EQ(complaint(world), "");
  world.X_WB_start.p.z() = 1.5;
  EXPECT_NE(complaint(world).find("hangs 1.50 m above the ground"), std::string::npos);
  world.X_WB_start.p = {7.0, 0.0, 0.04};  // beside the ground, on a pad that nothing carries
  world.objects.push_back({"pad", geometry::Cylinder{1.0, 0.02}, {base::Quat::Identity(), {7.0, 0, 0.02}}, 0});
  EXPECT_NE(complaint(world).find("no ground under the start"), std::string::npos);
}

}  // namespace
}  // namespace alula::worlds
