#include "worlds/courtyard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <queue>
#include <set>
#include <vector>

#include "base/config.h"
#include "base/error.h"
#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

CourtyardConfig Small() {  // the textures' size changes nothing else
  CourtyardConfig config;
  config.texture_size = 32;
  return config;
}

/// The corners and edge points of an object's triangles in the world, dense enough (0.1 m) to stand for its surface.
std::vector<Vec3> SurfacePoints(const Object& object) {
  std::vector<Vec3> points;
  const geometry::Mesh mesh = geometry::Tessellate(object.shape, 1.0, 16);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = object.X_WO * Vec3(mesh.vertices[t[0]].position.cast<double>());
    const Vec3 b = object.X_WO * Vec3(mesh.vertices[t[1]].position.cast<double>());
    const Vec3 c = object.X_WO * Vec3(mesh.vertices[t[2]].position.cast<double>());
    const int n = static_cast<int>(std::ceil(std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()}) / 0.1));
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) points.push_back(a + (b - a) * i / n + (c - a) * j / n);
    }
  }
  return points;
}

bool StartsWith(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }
bool IsSurround(const Object& o) { return StartsWith(o.name, "ground") || StartsWith(o.name, "wall"); }

double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Distance of an object from the gate's axis over 2 m before and after the opening; for the gate's own parts, by how
/// much they stay outside the prism of the opening plus the 0.9 m asked of others, so that one bound serves both.
double RoomAtGate(const Gate& gate, const Object& object, const std::vector<Vec3>& points) {
  const bool own = StartsWith(object.name, gate.name + "/");
  const Vec3 before = gate.X_WG * Vec3(-2.0, 0.0, 0.0);
  const Vec3 after = gate.X_WG * Vec3(2.0, 0.0, 0.0);
  const base::Transform X_GW = gate.X_WG.Inverse();
  double least = 1e9;
  for (const Vec3& p : points) {
    const Vec3 p_G = X_GW * p;
    const double outside = std::max(std::abs(p_G.y()), std::abs(p_G.z())) - 0.5 * gate.opening;
    least = std::min(least, own ? outside + 0.9 : DistanceToSegment(p, before, after));
  }
  return least;
}

TEST(Courtyard, RoomThatMustBeFreeIsFree) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const World world = MakeWorld(Small(), seed);
    ASSERT_EQ(world.gates.size(), 5U);
    const Vec2 pad = world.X_WB_start.p.head<2>();
    for (const Object& object : world.objects) {
      if (StartsWith(object.name, "ground")) continue;
      SCOPED_TRACE(object.name);
      const std::vector<Vec3> points = SurfacePoints(object);
      for (const Gate& gate : world.gates) EXPECT_GE(RoomAtGate(gate, object, points), 0.9 - 1e-6) << gate.name;
      double to_pad = 1e9;
      double to_target = 1e9;
      Vec3 low = Vec3::Constant(1e9);
      Vec3 high = -low;
      for (const Vec3& p : points) {
        to_pad = std::min(to_pad, (p.head<2>() - pad).norm());
        to_target = std::min(to_target, (p - world.target).norm());
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      if (object.name != world.pad_object) {
        EXPECT_GE(to_pad, 1.2);
      }
      EXPECT_GE(to_target, 1.0);
      EXPECT_GE(low.z(), -1e-6);
      if (IsSurround(object)) continue;
      EXPECT_LE(std::max(high.x(), -low.x()), 15.0 + 1e-6);
      EXPECT_LE(std::max(high.y(), -low.y()), 10.0 + 1e-6);
    }
  }
}

/// A grid of the courtyard seen from above; a cell is blocked where anything lower than 3.5 m is nearer than
/// `clearance`.
class Grid {
 public:
  static constexpr double kCell = 0.2;
  static constexpr int kNx = 150;
  static constexpr int kNy = 100;

  Grid(const World& world, double clearance) : blocked_(kNx * kNy, false) {
    for (int i = 0; i < kNx * kNy; ++i) {  // the walls' inner faces
      const Vec2 p = Centre(i % kNx, i / kNx).cwiseAbs();
      blocked_[i] = p.x() > 15.0 - clearance || p.y() > 10.0 - clearance;
    }
    const int reach = static_cast<int>(std::ceil(clearance / kCell)) + 1;
    for (const Object& object : world.objects) {
      if (IsSurround(object) || object.name == world.pad_object) continue;
      for (const Vec3& p : SurfacePoints(object)) {
        const Vec2 q = p.head<2>();
        const int cx = Column(q.x(), 15.0);
        const int cy = Column(q.y(), 10.0);
        for (int y = std::max(0, cy - reach); y <= std::min(kNy - 1, cy + reach); ++y) {
          for (int x = std::max(0, cx - reach); x <= std::min(kNx - 1, cx + reach); ++x) {
            if ((Centre(x, y) - q).norm() < clearance) blocked_[Index(x, y)] = true;
          }
        }
      }
    }
  }

  /// Steps of the shortest 4-connected way in metres, or infinity.
  double Way(const Vec2& from, const Vec2& to) const {
    std::vector<int> steps(kNx * kNy, -1);
    const int goal = Index(Column(to.x(), 15.0), Column(to.y(), 10.0));
    std::queue<int> open;
    open.push(Index(Column(from.x(), 15.0), Column(from.y(), 10.0)));
    steps[open.front()] = 0;
    while (!open.empty()) {
      const int at = open.front();
      open.pop();
      if (at == goal) return steps[at] * kCell;
      const int x = at % kNx;
      const int y = at / kNx;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || x + dx >= kNx || y + dy < 0 || y + dy >= kNy) continue;
        const int next = Index(x + dx, y + dy);
        if (blocked_[next] || steps[next] >= 0) continue;
        steps[next] = steps[at] + 1;
        open.push(next);
      }
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  static int Column(double v, double half) { return static_cast<int>(std::floor((v + half) / kCell)); }
  static Vec2 Centre(int x, int y) { return {-15.0 + (x + 0.5) * kCell, -10.0 + (y + 0.5) * kCell}; }
  static int Index(int x, int y) { return y * kNx + x; }

  std::vector<bool> blocked_;
};

/// Between any two stations there is a way with 0.6 m on both sides of its middle, without flying over anything.
TEST(Courtyard, EveryLegCanBeFlownWithRoomOnBothSides) {
  int straight = 0;
  int legs = 0;
  for (std::uint64_t seed = 1; seed <= 200; seed += 5) {
    SCOPED_TRACE(seed);
    const World world = MakeWorld(Small(), seed);
    const Grid grid(world, 0.6);
    Vec2 at = world.X_WB_start.p.head<2>();
    for (std::size_t i = 0; i <= world.gates.size(); ++i) {
      const bool last = i == world.gates.size();
      const Vec3 goal = last ? world.target : world.gates[i].X_WG * Vec3(-1.5, 0.0, 0.0);
      const double way = grid.Way(at, goal.head<2>());
      const double manhattan = (goal.head<2>() - at).lpNorm<1>();
      EXPECT_LE(way, manhattan + 6.0) << "to station " << i;  // a detour, not a journey
      straight += way <= manhattan + 0.5 ? 1 : 0;
      ++legs;
      if (!last) at = (world.gates[i].X_WG * Vec3(1.5, 0.0, 0.0)).head<2>();
    }
  }
  EXPECT_LT(straight, legs);
}

/// Some straight lines between gates are blocked for a hull of 0.3 m radius, and some are not.
TEST(Courtyard, StraightLinesBetweenGatesAreSometimesBlocked) {
  int blocked = 0;
  int legs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const World world = MakeWorld(Small(), seed);
    for (std::size_t i = 0; i + 1 < world.gates.size(); ++i) {
      const Vec3 a = world.gates[i].X_WG * Vec3(1.0, 0.0, 0.0);
      const Vec3 b = world.gates[i + 1].X_WG * Vec3(-1.0, 0.0, 0.0);
      bool hit = false;
      for (const Object& object : world.objects) {
        if (IsSurround(object) || object.name == world.pad_object) continue;
        for (const Vec3& p : SurfacePoints(object)) hit = hit || DistanceToSegment(p, a, b) < 0.3;
      }
      blocked += hit ? 1 : 0;
      ++legs;
    }
  }
  EXPECT_GT(blocked, legs / 10);
  EXPECT_LT(blocked, legs / 2);
  RecordProperty("blocked_percent", 100 * blocked / legs);
}

TEST(Courtyard, HasFewTriangles) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::size_t triangles = 0;
    for (const Object& object : MakeWorld(Small(), seed).objects) {
      triangles += geometry::Tessellate(object.shape, object.texture_scale).triangles.size();
    }
    EXPECT_LE(triangles, 30'000U) << seed;
  }
}

TEST(Courtyard, NamesAndMaterialsAreSound) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const World world = MakeWorld(Small(), seed);
    std::set<std::string> names;
    for (const Object& object : world.objects) {
      EXPECT_TRUE(names.insert(object.name).second) << object.name;
      ASSERT_GE(object.material, 0);
      ASSERT_LT(static_cast<std::size_t>(object.material), world.materials.size());
    }
    EXPECT_TRUE(names.count("gate0/left") == 1 && names.count("gate4/bottom") == 1);
    EXPECT_TRUE(names.count("prop") == 1 && names.count(world.pad_object) == 1);
  }
}

TEST(Courtyard, StartLooksTowardTheFirstGate) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const World world = MakeWorld(Small(), seed);
    const Vec3 d = world.gates.front().X_WG.p - world.X_WB_start.p;
    EXPECT_LE(std::abs(base::WrapAngle(std::atan2(d.y(), d.x()) - base::Yaw(world.X_WB_start.q))), 30.0 / 57.2957795);
    EXPECT_LE((world.target - world.X_WB_start.p).head<2>().norm(), 4.2);
  }
}

TEST(Courtyard, WindAndSunStayInTheirRanges) {
  double strongest = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const World world = MakeWorld(Small(), seed);
    strongest = std::max(strongest, world.wind.mean_W.norm());
    EXPECT_LE(world.wind.mean_W.norm(), 3.0);
    EXPECT_LE(world.wind.gust_sigma, 0.3 * world.wind.mean_W.norm() + 1e-12);
    EXPECT_NEAR(world.light.to_sun_W.norm(), 1.0, 1e-12);
    EXPECT_GT(world.light.to_sun_W.z(), 0.4);
  }
  EXPECT_GT(strongest, 2.5);
}

std::uint64_t Digest(const World& world) {
  base::RollingHash hash;
  AddTo(hash, world);
  return hash.value();
}

TEST(Courtyard, SameSeedSameWorldAndEverySeedAnotherOne) {
  std::set<std::uint64_t> digests;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::uint64_t digest = Digest(MakeWorld(Small(), seed));
    EXPECT_TRUE(digests.insert(digest).second) << seed;
    if (seed % 20 == 0) {
      EXPECT_EQ(digest, Digest(MakeWorld(Small(), seed))) << seed;
    }
  }
}

TEST(Courtyard, TextureSizeChangesNothingElse) {
  World small = MakeWorld(Small(), 5);
  World large = MakeWorld(CourtyardConfig{}, 5);
  for (World* world : {&small, &large}) {
    for (auto& material : world->materials) material.texture.reset();
  }
  EXPECT_EQ(Digest(small), Digest(large));
}

TEST(Courtyard, AMissingPropIsNamed) {
  CourtyardConfig config = Small();
  config.prop = "nothing.obj";
  try {
    MakeWorld(config, 1);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("worlds/assets/nothing.obj: there is no such mesh file"),
              std::string::npos);
  }
}

TEST(Courtyard, EveryObjectSaysWhatItIs) {
  const World world = MakeWorld(Small(), 2);
  const auto expected = [](const std::string& name) {
    const std::pair<const char*, SemanticClass> beginnings[] = {
        {"ground/", SemanticClass::kGround}, {"wall/", SemanticClass::kWall}, {"gate", SemanticClass::kGate},
        {"pad", SemanticClass::kPad},        {"tree", SemanticClass::kTree},
    };
    for (const auto& [beginning, semantic] : beginnings) {
      if (name.starts_with(beginning)) return semantic;
    }
    // Of the blockers, conifers alone have crowns and trunks.
    const bool tree = name.find("/crown") != std::string::npos || name.find("/trunk") != std::string::npos;
    return tree ? SemanticClass::kTree : SemanticClass::kObstacle;
  };
  std::set<SemanticClass> met;
  for (const Object& object : world.objects) {
    EXPECT_EQ(NameOf(object.semantic), NameOf(expected(object.name))) << object.name;
    met.insert(object.semantic);
  }
  EXPECT_EQ(met.size(), 6U);  // all but sky and vehicle
}

CourtyardConfig FromYaml(const std::string& text) {
  return base::ReadConfig<CourtyardConfig>(base::YamlDocument::Parse(text, "courtyard.yaml", {}), 1);
}

TEST(Courtyard, NightFogAndLampsAreKeys) {
  const CourtyardConfig config = FromYaml(
      "{texture_size: 32, sunlight: 0, skylight: 0.01, fog: {visibility: 40 m, colour: [0.1, 0.1, 0.12]},\n"
      " lamps: [{position: [1 m, 2 m, 3 m], intensity: 30, range: 12 m}, {position: [4 m, 0 m, 3 m], cone: 40 deg, "
      "direction: [0, "
      "0, -1]}]}");
  const World night = MakeWorld(config, 2);
  EXPECT_EQ(night.light.sun, 0.0F);
  EXPECT_FLOAT_EQ(night.light.sky_brightness, 0.1F);
  ASSERT_TRUE(night.light.fog.has_value());
  EXPECT_EQ(night.light.fog->visibility, 40.0);
  ASSERT_EQ(night.light.lamps.size(), 2U);
  EXPECT_EQ(night.light.lamps[0].position, Vec3(1, 2, 3));
  EXPECT_NEAR(night.light.lamps[1].cone, 0.698132, 1e-6);
  // They are part of what the world is; the rest of it is the same as by day.
  const World day = MakeWorld(Small(), 2);
  EXPECT_NE(Digest(night), Digest(day));
  World again = night;
  again.light = day.light;
  EXPECT_EQ(Digest(again), Digest(day));
}

TEST(Courtyard, WrongFogAndLampsAreBadInput) {
  const std::pair<const char*, const char*> wrong[] = {
      {"{fog: {visibility: -5 m}}", "fog.visibility"},
      {"{fog: {colour: [0.1, 2, 0]}}", "colour"},
      {"{lamps: [{cone: 4 rad}]}", "lamps.0.cone"},
      {"{lamps: [{direction: [0, 0, 0]}]}", "direction"},
      {"{lamps: [{intensity: -1}]}", "lamps.0.intensity"},
      {"{lamps: [{range: 0 m}]}", "lamps.0.range"},
      {"{skylight: -1}", "skylight"},
  };
  for (const auto& [text, key] : wrong) {
    try {
      FromYaml(text);
      ADD_FAILURE() << text;
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  }
}

/// People and swinging gates change nothing of what else the seed draws.
TEST(Courtyard, PeopleAndSwingingGatesLeaveTheRestAsItIs) {
  CourtyardConfig lively = Small();
  lively.people = 4;
  lively.swinging_gates = 2;
  const World still = MakeWorld(Small(), 7);
  const World moving = MakeWorld(lively, 7);
  EXPECT_TRUE(still.actors.empty());
  EXPECT_EQ(moving.actors.size(), 6U);
  ASSERT_EQ(moving.gates.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(moving.gates[i].X_WG.p, still.gates[i].X_WG.p);
  std::map<std::string, base::Vec3> places;
  for (const Object& object : moving.objects) places[object.name] = object.X_WO.p;
  for (const Object& object : still.objects) {
    if (object.name.starts_with("gate")) continue;
    ASSERT_TRUE(places.contains(object.name)) << object.name;
    EXPECT_EQ(places[object.name], object.X_WO.p) << object.name;
  }
  EXPECT_EQ(moving.wind.mean_W, still.wind.mean_W);
  lively.people = 20;
  lively.trees = 12;
  EXPECT_EQ(MakeWorld(lively, 7).actors.size(), 22U) << "a full courtyard still has room for them";
}

}  // namespace
}  // namespace alula::worlds
