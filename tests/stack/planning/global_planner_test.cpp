#include "stack/planning/global_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/stack/planning/synthetic_map.h"

namespace alula::stack::planning {
namespace {

using base::Transform;
using base::Vec3;

const Vec3 kLow(-1, -3, 0);
const Vec3 kHigh(9, 3, 3);

Transform At(double x, double y, double z) { return {base::Quat::Identity(), {x, y, z}}; }

PlanRequest Request(tests::SyntheticMap& map, const Vec3& start, const Vec3& goal) {
  map.RevealAll();
  PlanRequest request;
  request.field = map.Snapshot();
  request.start_O = start;
  request.goal_O = goal;
  request.bounds_low_O = kLow;
  request.bounds_high_O = kHigh;
  request.seed = 7;
  request.number = 3;
  return request;
}

/// A wall across the box at x = 4 with a hole of the given half width at y = 1.5.
tests::SyntheticMap Wall(double half_hole) {
  tests::SyntheticMap map(kLow, kHigh);
  map.AddBox(At(4, -1.5 - 0.5 * half_hole, 1.5), {0.2, 3.0 - 0.5 * half_hole, 1.6});
  map.AddBox(At(4, 3.0, 1.5), {0.2, 1.5 - half_hole, 1.6});
  return map;
}

double SmallestClearance(const tests::SyntheticMap& map, const std::vector<Vec3>& path) {
  double smallest = 10.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int steps = static_cast<int>((path[i] - path[i - 1]).norm() / 0.03) + 1;
    for (int k = 0; k <= steps; ++k) {
      smallest = std::min(smallest, map.TrueDistance(path[i - 1] + (path[i] - path[i - 1]) * k / steps, 0.6));
    }
  }
  return smallest;
}

// The checker's adaptive steps against dense sampling: it may only be wrong where the clearance is within the field's
// interpolation error (some mm) of what is required.
TEST(SegmentChecker, AgreesWithDenseSampling) {
  tests::SyntheticMap map(kLow, kHigh);
  base::RandomStream random(1, "boxes");
  for (int i = 0; i < 25; ++i) {
    map.AddBox(At(random.Uniform(0, 8), random.Uniform(-3, 3), random.Uniform(0, 3)),
               {random.Uniform(0.1, 0.4), random.Uniform(0.1, 0.4), random.Uniform(0.1, 0.4)});
  }
  PlanRequest request = Request(map, {0, 0, 1}, {0, 0, 1});
  request.limit_climb = false;
  GlobalPlannerConfig config;
  config.height_min = 0.0;
  request.clearance = std::min(0.35, request.field->Clearance(request.start_O));
  const SegmentChecker checker(request, config);
  int free = 0, blocked = 0;
  for (int i = 0; i < 800; ++i) {
    const Vec3 a(random.Uniform(-1, 9), random.Uniform(-3, 3), random.Uniform(0, 3));
    const Vec3 b(random.Uniform(-1, 9), random.Uniform(-3, 3), random.Uniform(0, 3));
    double smallest = 10.0;
    for (int k = 0; k <= 1000; ++k) smallest = std::min(smallest, request.field->Clearance(a + (b - a) * (k / 1000.0)));
    if (checker.SegmentFree(a, b)) {
      ++free;
      EXPECT_GT(smallest, request.clearance - 0.02);
    } else {
      ++blocked;
      EXPECT_LT(smallest, request.clearance + 1e-9);
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
}

TEST(GlobalPlanner, TakesTheStraightLineWhereItIsFree) {
  tests::SyntheticMap map(kLow, kHigh);
  const auto planner = MakeInformedRrtStarPlanner({});
  const PlanResult result = planner->Plan(Request(map, {0, 0, 1}, {8, 0, 1.5}));
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.source, PlanResult::Source::kStraight);
  EXPECT_EQ(result.path_O.size(), 2U);
  EXPECT_EQ(result.reason, "");
}

TEST(GlobalPlanner, FindsTheHoleInTheWallWithClearance) {
  tests::SyntheticMap map = Wall(0.6);
  const auto planner = MakeInformedRrtStarPlanner({});
  const PlanResult result = planner->Plan(Request(map, {0, -2, 1}, {8, -2, 1}));
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_EQ(result.source, PlanResult::Source::kSearch);
  EXPECT_GT(SmallestClearance(map, result.path_O), 0.35 - 0.03);
  // The shortest way: through the hole's near edge.
  double length = 0.0;
  for (std::size_t i = 1; i < result.path_O.size(); ++i) length += (result.path_O[i] - result.path_O[i - 1]).norm();
  EXPECT_LT(length, 2.0 * std::hypot(4.0, 3.3) * 1.08);
}

TEST(GlobalPlanner, SameRequestSameAnswer) {
  tests::SyntheticMap map = Wall(0.6);
  const PlanRequest request = Request(map, {0, -2, 1}, {8, -2, 1});
  const PlanResult a = MakeInformedRrtStarPlanner({})->Plan(request);
  const PlanResult b = MakeInformedRrtStarPlanner({})->Plan(request);
  ASSERT_EQ(a.path_O.size(), b.path_O.size());
  for (std::size_t i = 0; i < a.path_O.size(); ++i) EXPECT_EQ(a.path_O[i], b.path_O[i]);
}

TEST(GlobalPlanner, SaysWhyThereIsNoPath) {
  tests::SyntheticMap map(kLow, kHigh);
  map.AddBox(At(4, 0, 1.5), {0.2, 3.1, 1.6});
  const PlanResult result = MakeInformedRrtStarPlanner({})->Plan(Request(map, {0, 0, 1}, {8, 0, 1}));
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("no path with 0.35 m of clearance"), std::string::npos) << result.reason;
}

TEST(GlobalPlanner, SaysThatTheGoalIsBlocked) {
  tests::SyntheticMap map = Wall(0.6);
  const PlanResult result = MakeInformedRrtStarPlanner({})->Plan(Request(map, {0, 0, 1}, {4, -1, 1}));
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("the goal is 0.00 m from an obstacle"), std::string::npos) << result.reason;
}

TEST(GlobalPlanner, BacksOffFromAStartTooNearToAnObstacle) {
  tests::SyntheticMap map(kLow, kHigh);
  map.AddBox(At(0, 1.0, 1), {0.5, 0.3, 0.8});  // faces at y = 0.7
  const PlanResult result = MakeInformedRrtStarPlanner({})->Plan(Request(map, {0, 0.55, 1}, {6, 0, 1}));
  ASSERT_TRUE(result.found);
  EXPECT_NE(result.reason.find("backing off"), std::string::npos) << result.reason;
}

TEST(GlobalPlanner, KeepsThePreviousPathWhileItHolds) {
  tests::SyntheticMap map = Wall(0.6);
  PlanRequest request = Request(map, {0, -2, 1}, {8, -2, 1});
  const auto planner = MakeInformedRrtStarPlanner({});
  const PlanResult first = planner->Plan(request);
  ASSERT_TRUE(first.found);
  request.previous.assign(first.path_O.begin() + 1, first.path_O.end() - 1);
  request.start_O = first.path_O[0] + 0.3 * (first.path_O[1] - first.path_O[0]);
  request.number = 99;
  const PlanResult second = planner->Plan(request);
  ASSERT_TRUE(second.found);
  EXPECT_EQ(second.source, PlanResult::Source::kPrevious);
}

TEST(GlobalPlanner, DoesNotCrossAClosedOpening) {
  tests::SyntheticMap map = Wall(0.6);
  PlanRequest request = Request(map, {0, -2, 1}, {8, -2, 1});
  request.closed.push_back({At(4, 1.5, 1.5), 3.2});  // all of the hole
  EXPECT_FALSE(MakeInformedRrtStarPlanner({})->Plan(request).found);
}

TEST(GlobalPlanner, ClimbsNoSteeperThanAllowed) {
  tests::SyntheticMap map(kLow, kHigh);
  map.AddBox(At(4, 0, 0.6), {0.2, 3.1, 1.0});  // a wall 1.6 m high
  GlobalPlannerConfig config;
  const PlanResult result = MakeInformedRrtStarPlanner(config)->Plan(Request(map, {0, 0, 0.8}, {8, 0, 0.8}));
  ASSERT_TRUE(result.found) << result.reason;
  for (std::size_t i = 1; i < result.path_O.size(); ++i) {
    const Vec3 d = result.path_O[i] - result.path_O[i - 1];
    EXPECT_LE(std::abs(d.z()), std::tan(config.max_climb_angle) * d.head<2>().norm() + 0.021);
  }
}

}  // namespace
}  // namespace alula::stack::planning
