#include "worlds/maps/planning_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <string>

#include "base/hash.h"
#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;
using Layout = PlanningMapConfig::Layout;

PlanningMapConfig ConfigOf(Layout layout) {
  PlanningMapConfig config;
  config.layout = layout;
  config.texture_size = 32;
  if (layout == Layout::kOpen) config.radius_max = 5.0, config.gap = 4.0;
  if (layout == Layout::kCluttered)
    config.obstacles = 220, config.radius_min = 0.5, config.radius_max = 2.2, config.gap = 1.6;
  return config;
}

/// Outline of an upright obstacle from above: a circle, or the box of a mesh's corners in its own axes.
struct Outline {
  base::Transform X_WO;
  double radius = 0.0;  // of a round one
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  /// Nothing of it lies farther from its origin.
  double Reach() const { return radius > 0.0 ? radius : low.cwiseAbs().cwiseMax(high.cwiseAbs()).head<2>().norm(); }
  double Distance(const Vec2& p) const {
    const Vec3 q = X_WO.Inverse() * Vec3(p.x(), p.y(), X_WO.p.z());
    if (radius > 0.0) return q.head<2>().norm() - radius;
    const Vec2 outside = (low.head<2>() - q.head<2>()).cwiseMax(q.head<2>() - high.head<2>()).cwiseMax(0.0);
    return outside.norm();
  }
};

std::vector<Outline> OutlinesOf(const World& world) {
  std::vector<Outline> outlines;
  for (const Object& object : world.objects) {
    if (object.semantic == SemanticClass::kGround || object.semantic == SemanticClass::kPad) continue;
    Outline outline{object.X_WO};
    if (const auto* round = std::get_if<geometry::Cylinder>(&object.shape)) {
      outline.radius = round->radius;
    } else {
      outline.low = Vec3::Constant(1e9);
      outline.high = -outline.low;
      for (const auto& v : std::get<geometry::MeshShape>(object.shape).mesh->vertices) {
        outline.low = outline.low.cwiseMin(v.position.cast<double>());
        outline.high = outline.high.cwiseMax(v.position.cast<double>());
      }
    }
    outlines.push_back(outline);
  }
  return outlines;
}

/// Cells of 0.5 m whose centre keeps `clearance` from everything.
class Grid {
 public:
  Grid(const World& world, double clearance) : free_(kSide * kSide, true) {
    for (const Outline& outline : OutlinesOf(world)) {
      const double reach = outline.Reach() + clearance;
      const Vec2 p = outline.X_WO.p.head<2>();
      const int first = CellOf((p - Vec2::Constant(reach)).cwiseMax(-0.999 * kMapHalf).cwiseMin(0.999 * kMapHalf));
      const int last = CellOf((p + Vec2::Constant(reach)).cwiseMax(-0.999 * kMapHalf).cwiseMin(0.999 * kMapHalf));
      for (int y = first / kSide; y <= last / kSide; ++y) {
        for (int x = first % kSide; x <= last % kSide; ++x) {
          const int cell = y * kSide + x;
          if (outline.Distance(Centre(cell)) < clearance) free_[static_cast<std::size_t>(cell)] = false;
        }
      }
    }
  }
  bool Connects(const Vec2& from, const Vec2& to) const {
    std::vector<bool> seen(free_.size(), false);
    std::queue<int> open;
    open.push(CellOf(from));
    seen[static_cast<std::size_t>(open.front())] = true;
    while (!open.empty()) {
      const int cell = open.front();
      open.pop();
      if (cell == CellOf(to)) return true;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int x = cell % kSide + dx;
        const int y = cell / kSide + dy;
        if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
        const int next = y * kSide + x;
        if (!free_[static_cast<std::size_t>(next)] || seen[static_cast<std::size_t>(next)]) continue;
        seen[static_cast<std::size_t>(next)] = true;
        open.push(next);
      }
    }
    return false;
  }

 private:
  static constexpr int kSide = 400;  // cells
  static constexpr double kCell = 2.0 * kMapHalf / kSide;
  static Vec2 Centre(int cell) {
    return {-kMapHalf + (cell % kSide + 0.5) * kCell, -kMapHalf + (cell / kSide + 0.5) * kCell};
  }
  static int CellOf(const Vec2& p) {
    return static_cast<int>((p.y() + kMapHalf) / kCell) * kSide + static_cast<int>((p.x() + kMapHalf) / kCell);
  }
  std::vector<bool> free_;
};

class EachLayout : public testing::TestWithParam<Layout> {};

TEST_P(EachLayout, HasAWayFromStartToTarget) {
  PlanningMapConfig config = ConfigOf(GetParam());
  config.weather.cloud = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const World world = MakeWorld(config, seed);
    EXPECT_TRUE(Grid(world, 0.5).Connects(world.X_WB_start.p.head<2>(), world.target.head<2>())) << "seed " << seed;
  }
}

TEST_P(EachLayout, SeedsDifferAndRepeat) {
  const auto digest = [](std::uint64_t seed) {
    base::RollingHash hash;
    AddTo(hash, MakeWorld(ConfigOf(GetParam()), seed));
    return hash.value();
  };
  EXPECT_EQ(digest(1), digest(1));
  EXPECT_NE(digest(1), digest(2));
}

std::string NameOf(const testing::TestParamInfo<Layout>& layout) {
  constexpr std::array<const char*, 3> kNames{"open", "corridors", "cluttered"};
  return kNames[static_cast<std::size_t>(layout.param)];
}
INSTANTIATE_TEST_SUITE_P(Layouts, EachLayout, testing::Values(Layout::kOpen, Layout::kCorridors, Layout::kCluttered),
                         NameOf);

/// Between two sections of a barrier lies the corridor's width, and the outer walls close its ends.
TEST(PlanningMap, CorridorsAreAsWideAsConfigured) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = MakeWorld(ConfigOf(Layout::kCorridors), seed);
    std::map<std::string, std::pair<double, double>> sections;  // along the barrier, from – to
    const Vec3 along = Vec3(-1.0, 1.0, 0.0).normalized();
    for (const Object& object : world.objects) {
      if (!object.name.starts_with("barrier")) continue;
      const std::string section = object.name.substr(0, object.name.rfind('/'));
      auto& [low, high] = sections.try_emplace(section, 1e9, -1e9).first->second;
      for (const auto& v : std::get<geometry::MeshShape>(object.shape).mesh->vertices) {
        const double t = along.dot(object.X_WO * Vec3(v.position.cast<double>()));
        low = std::min(low, t);
        high = std::max(high, t);
      }
    }
    ASSERT_EQ(sections.size(), 15U);  // five barriers with two passages each
    for (int barrier = 0; barrier < 5; ++barrier) {
      const std::string name = "barrier" + std::to_string(barrier) + "/";
      for (int i = 0; i < 2; ++i) {
        const double gap =
            sections.at(name + std::to_string(i + 1)).first - sections.at(name + std::to_string(i)).second;
        EXPECT_NEAR(gap, 2.0, 1e-4);  // vertices are floats of up to 70 m
      }
    }
    EXPECT_FALSE(Grid(world, 1.05).Connects(world.X_WB_start.p.head<2>(), world.target.head<2>())) << "seed " << seed;
  }
}

}  // namespace
}  // namespace alula::worlds
