#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <set>

#include "base/hash.h"
#include "worlds/indoor/machine_hall.h"
#include "worlds/indoor/office.h"
#include "worlds/indoor/office_floor.h"
#include "worlds/indoor/vicon_room.h"
#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

/// What an object covers between two heights, from above: a circle or a rectangle in its own axes where it stands
/// upright, else the box of the world's axes around it (never less than it covers).
class Outline {
 public:
  Outline(const Object& object, double z_low, double z_high) {
    const geometry::Mesh mesh = geometry::Tessellate(object.shape);
    const bool upright = std::abs(object.X_WO.R()(2, 2)) > 1.0 - 1e-9;
    const base::Transform X_OW = upright ? object.X_WO.Inverse() : base::Transform{};
    double bottom = 1e9;
    double top = -1e9;
    for (const auto& vertex : mesh.vertices) {
      const Vec3 p_W = object.X_WO * Vec3(vertex.position.cast<double>());
      bottom = std::min(bottom, p_W.z());
      top = std::max(top, p_W.z());
      const Vec3 p = X_OW * p_W;
      low_ = low_.cwiseMin(p.head<2>());
      high_ = high_.cwiseMax(p.head<2>());
      reach_ = std::max(reach_, (p_W - object.X_WO.p).head<2>().norm());
    }
    X_OW_ = X_OW;
    centre_ = object.X_WO.p.head<2>();
    present_ = top > z_low + 1e-6 && bottom < z_high - 1e-6;
    if (upright && std::holds_alternative<geometry::Cylinder>(object.shape)) {
      radius_ = std::get<geometry::Cylinder>(object.shape).radius;
    }
  }
  bool IsPresent() const { return present_; }
  Vec2 Centre() const { return centre_; }
  double Reach() const { return reach_; }
  double Distance(const Vec2& p_W) const {
    if (radius_ > 0.0) return (p_W - centre_).norm() - radius_;
    const Vec2 p = (X_OW_ * Vec3(p_W.x(), p_W.y(), 0.0)).head<2>();
    return (low_ - p).cwiseMax(p - high_).cwiseMax(0.0).norm();
  }

 private:
  base::Transform X_OW_;
  Vec2 centre_{0.0, 0.0}, low_{1e9, 1e9}, high_{-1e9, -1e9};
  double reach_ = 0.0, radius_ = 0.0;
  bool present_ = false;
};

std::vector<Outline> OutlinesBetween(const World& world, double z_low, double z_high) {
  std::vector<Outline> outlines;
  for (const Object& object : world.objects) {
    if (Outline outline(object, z_low, z_high); outline.IsPresent()) outlines.push_back(outline);
  }
  return outlines;
}

/// Whether a cylinder of this radius can be moved from start to target at a height: cells of 5 cm, a breadth-first
/// search.
bool HasAWay(const World& world, double radius, double z) {
  constexpr double kCell = 0.05;
  const Vec2 low = world.bounds_low.head<2>();
  const int columns = static_cast<int>((world.bounds_high.x() - low.x()) / kCell);
  const int rows = static_cast<int>((world.bounds_high.y() - low.y()) / kCell);
  std::vector<char> taken(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (const Outline& outline : OutlinesBetween(world, z - 0.15, z + 0.15)) {
    const Vec2 first = (outline.Centre() - low).array() - outline.Reach() - radius;
    const Vec2 last = (outline.Centre() - low).array() + outline.Reach() + radius;
    for (int y = std::max(0, static_cast<int>(first.y() / kCell)); y <= last.y() / kCell && y < rows; ++y) {
      for (int x = std::max(0, static_cast<int>(first.x() / kCell)); x <= last.x() / kCell && x < columns; ++x) {
        const Vec2 p = low + kCell * Vec2(x + 0.5, y + 0.5);
        if (outline.Distance(p) < radius) taken[static_cast<std::size_t>(y * columns + x)] = 1;
      }
    }
  }
  const auto cell_of = [&](const Vec3& p) {
    return static_cast<int>((p.y() - low.y()) / kCell) * columns + static_cast<int>((p.x() - low.x()) / kCell);
  };
  const int goal = cell_of(world.target);
  std::queue<int> open;
  open.push(cell_of(world.X_WB_start.p));
  if (taken[static_cast<std::size_t>(open.front())] != 0) return false;
  while (!open.empty()) {
    const int cell = open.front();
    open.pop();
    if (cell == goal) return true;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = cell % columns + dx;
      const int y = cell / columns + dy;
      if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
      char& next = taken[static_cast<std::size_t>(y * columns + x)];
      if (next == 0) open.push(y * columns + x);
      next = 1;
    }
  }
  return false;
}

struct Kind {
  const char* name;
  std::function<World(std::uint64_t)> make;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }  // in the names of tests
template <typename Config>
World MakeSmall(std::uint64_t seed, Config config = {}) {
  config.texture_size = 32;
  return MakeWorld(config, seed);
}
std::vector<Kind> Kinds() {
  return {
      {"machine_hall", [](std::uint64_t seed) { return MakeSmall<MachineHallConfig>(seed); }},
      {"machine_hall_bare", [](std::uint64_t seed) { return MakeSmall(seed, MachineHallConfig{.bare_walls = true}); }},
      {"vicon_room", [](std::uint64_t seed) { return MakeSmall<ViconRoomConfig>(seed); }},
      {"vicon_room_bare", [](std::uint64_t seed) { return MakeSmall(seed, ViconRoomConfig{.bare_walls = true}); }},
      {"office", [](std::uint64_t seed) { return MakeSmall<OfficeConfig>(seed); }},
      {"office_floor", [](std::uint64_t seed) { return MakeSmall<OfficeFloorConfig>(seed); }}};
}

class Indoor : public testing::TestWithParam<Kind> {};

TEST_P(Indoor, SeedsDifferAndRepeat) {
  const auto digest = [](std::uint64_t seed) {
    base::RollingHash hash;
    AddTo(hash, GetParam().make(seed));
    return hash.value();
  };
  EXPECT_EQ(digest(1), digest(1));
  EXPECT_NE(digest(1), digest(2));
}

TEST_P(Indoor, HasAWayForAQuadrotorFromStartToTarget) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = GetParam().make(seed);
    EXPECT_LT(world.objects.size(), 2000U);
    EXPECT_TRUE(HasAWay(world, 0.3, std::min(world.target.z(), 1.3))) << "seed " << seed;
  }
}

TEST_P(Indoor, AirAboveTheStartIsFree) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = GetParam().make(seed);
    for (const Outline& outline : OutlinesBetween(world, world.X_WB_start.p.z(), 1.8)) {
      EXPECT_GT(outline.Distance(world.X_WB_start.p.head<2>()), 0.28) << "seed " << seed;
    }
  }
}

TEST_P(Indoor, NamesAreUnique) {
  const World world = GetParam().make(3);
  std::set<std::string> names;
  for (const Object& object : world.objects) EXPECT_TRUE(names.insert(object.name).second) << object.name;
}

/// Between the floor and the ceiling, nothing lies outside the walls.
TEST_P(Indoor, HasACeilingAndStaysInside) {
  const World world = GetParam().make(5);
  bool ceiling = false;
  for (const Object& object : world.objects) ceiling = ceiling || object.name.starts_with("ceiling");
  EXPECT_TRUE(ceiling);
  const double ceiling_height = world.bounds_high.z();
  EXPECT_LT(world.target.z(), ceiling_height);
  for (const Object& object : world.objects) {
    if (object.name.starts_with("wall/") || object.name.starts_with("ceiling") || object.name.starts_with("floor")) {
      continue;
    }
    constexpr double kWall = 0.4;  // m, the thickest
    EXPECT_LT(std::abs(object.X_WO.p.x()), world.bounds_high.x() + kWall) << object.name;
    EXPECT_LT(std::abs(object.X_WO.p.y()), world.bounds_high.y() + kWall) << object.name;
    EXPECT_LT(object.X_WO.p.z(), ceiling_height + 0.2) << object.name;
    EXPECT_GT(object.X_WO.p.z(), 0.0) << object.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, Indoor, testing::ValuesIn(Kinds()),
                         [](const testing::TestParamInfo<Kind>& kind) { return std::string(kind.param.name); });

TEST(OfficeFloor, DoorwaysAreAsWideAsTheySay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = MakeSmall<OfficeFloorConfig>(seed);
    std::map<std::string, const Object*> by_name;
    for (const Object& object : world.objects) by_name[object.name] = &object;
    const auto outlines = OutlinesBetween(world, 0.1, 1.9);
    std::map<double, int> widths;
    for (int i = 0; i < 6; ++i) {
      const std::string name = "door" + std::to_string(i);
      const Object& left = *by_name.at(name + "/left");
      const Object& right = *by_name.at(name + "/right");
      const double half = std::get<geometry::Box>(left.shape).half_extents.x();
      const double width = (right.X_WO.p - left.X_WO.p).head<2>().norm() - 2.0 * half;
      const auto nearest = std::min_element(kDoorWidths.begin(), kDoorWidths.end(), [&](double a, double b) {
        return std::abs(a - width) < std::abs(b - width);
      });
      EXPECT_NEAR(width, *nearest, 1e-9) << name;
      ++widths[*nearest];
      // A disc that just fits passes from the corridor into the room: neither leaf nor furniture is in its way.
      const Vec2 middle = 0.5 * (right.X_WO.p + left.X_WO.p).head<2>();
      for (double across = -0.5; across <= 0.5; across += 0.05) {
        for (const Outline& outline : outlines) {
          EXPECT_GT(outline.Distance(middle + Vec2(0.0, across)), 0.5 * width - 1e-6) << name << " seed " << seed;
        }
      }
    }
    EXPECT_EQ(widths.size(), kDoorWidths.size());
  }
}

TEST(OfficeFloor, GlassDoorsAreOfGlassAndNoMoreThanThereAreDoors) {
  const World world = MakeSmall(1, OfficeFloorConfig{.glass_doors = 3});
  const auto panes = std::count_if(world.objects.begin(), world.objects.end(), [](const Object& object) {
    return object.semantic == SemanticClass::kGlass && object.collides;
  });
  EXPECT_EQ(panes, 3);
  OfficeFloorConfig config{.rooms = 2, .glass_doors = 5};
  base::Description d;
  Describe(d, config);
  std::string wrong;
  for (const auto& [key, check] : d.checks()) wrong += check();
  EXPECT_EQ(wrong, "must be at most 4, one for each room");
}

TEST(OfficeFloor, PeopleWalkTheCorridor) {
  const World world = MakeSmall(1, OfficeFloorConfig{.people = 2});
  ASSERT_EQ(world.actors.size(), 2U);
  for (const Vec3& p : std::get<Walk>(world.actors[0].motion).route) EXPECT_LT(std::abs(p.y()), 0.95);
}

TEST(IndoorLight, LampsAndHourDim) {
  RoomLight room;
  room.emergency.resize(1);
  const Light day = MakeLight({}, room);
  EXPECT_GT(day.sun, 0.0F);
  EXPECT_TRUE(day.lamps.empty());
  const Light night = MakeLight({.hour = WeatherConfig::Hour::kNight, .lamps = {}}, room);
  EXPECT_EQ(night.sun, 0.0F);
  EXPECT_LT(night.ambient, 0.1F * day.ambient);
  EXPECT_EQ(night.lamps.size(), 1U);
  const Light dark = MakeLight({.hour = WeatherConfig::Hour::kNight, .lamps = IndoorLightConfig::Lamps::kOff}, room);
  EXPECT_LT(dark.ambient, night.ambient);
  EXPECT_TRUE(dark.lamps.empty());
  const Light late = MakeLight({.hour = WeatherConfig::Hour::kNight, .lamps = IndoorLightConfig::Lamps::kOn}, room);
  EXPECT_EQ(late.sun, day.sun);
  EXPECT_LT(late.sky_brightness, 0.1F * day.sky_brightness);
}

}  // namespace
}  // namespace alula::worlds
