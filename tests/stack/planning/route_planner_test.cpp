#include "stack/planning/route_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/stack/planning/synthetic_map.h"

namespace alula::stack::planning {
namespace {

using base::Transform;
using base::Vec3;

const Vec3 kLow(-3, -6, -0.5);
const Vec3 kHigh(15, 6, 4);

Transform GateAt(double x, double y, double z, double yaw) { return {base::FromYaw(yaw), {x, y, z}}; }

RouteRequest Request(std::shared_ptr<const mapping::ClearanceField> field) {
  RouteRequest request;
  request.field = std::move(field);
  request.start.p_O = Vec3(0, 0, 1.2);
  request.bounds_low_O = kLow;
  request.bounds_high_O = kHigh;
  request.seed = 1;
  return request;
}

TEST(RoutePlanner, PassesTwoGatesStraightAndWithoutStopping) {
  tests::SyntheticMap map(kLow, kHigh);
  const Passage first{.gate = 0, .X_OG = GateAt(4, 0.5, 1.5, 0.2), .half_opening = 0.7};
  const Passage second{.gate = 1, .X_OG = GateAt(9, -1.5, 2.0, -0.7), .half_opening = 0.7};
  map.AddGate(first.X_OG, 1.4);
  map.AddGate(second.X_OG, 1.4);
  map.RevealAll();
  RouteRequest request = Request(map.Snapshot());
  request.passages = {first, second};
  request.target_O = Vec3(12, -3.5, 1.5);
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_EQ(result.end, RouteEnd::kTarget);
  const double duration = (result.trajectory->end() - result.trajectory->start()).Seconds();
  EXPECT_GT(result.length / duration, 1.5);
  for (base::Time t = result.trajectory->start(); t < result.trajectory->end(); t += base::Milliseconds(10)) {
    const TrajectoryPoint point = result.trajectory->Sample(t);
    EXPECT_GT(map.TrueDistance(point.p_O, 0.5), 0.24);
    for (const Passage& passage : {first, second}) {
      const Vec3 p_G = passage.X_OG.Inverse() * point.p_O;
      if (std::abs(p_G.x()) > 1.0 || p_G.norm() > 1.2) continue;
      EXPECT_LT(p_G.tail<2>().norm(), 0.06) << "straight along the normal, at x = " << p_G.x();
      EXPECT_LT(std::abs(base::WrapAngle(point.yaw - base::Yaw(passage.X_OG.q))), p_G.x() < 0 ? 0.35 : 1.3);
      EXPECT_GT(point.v_O.norm(), 1.2);
    }
  }
}

TEST(RoutePlanner, StopsAtTheViewPointOfAClosedGateAndLooksAtIt) {
  tests::SyntheticMap map(kLow, kHigh);
  Passage gate{.gate = 0, .X_OG = GateAt(7, 1, 1.5, 0.0), .half_opening = 0.7, .closed = true};
  gate.views_O = {gate.X_OG * Vec3(-2.2, 0, 0)};
  map.AddGate(gate.X_OG, 1.4);
  map.RevealAll();
  RouteRequest request = Request(map.Snapshot());
  request.passages = {gate};
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_EQ(result.end, RouteEnd::kClosedGate);
  EXPECT_LT((result.trajectory->end_point() - gate.views_O[0]).norm(), 0.25);
  EXPECT_NEAR(result.trajectory->Sample(result.trajectory->yaw_end()).yaw, 0.0, 0.2);
}

TEST(RoutePlanner, StopsInsideKnownFreeSpace) {
  tests::SyntheticMap map(kLow, kHigh);
  map.RevealBox(kLow, Vec3(3.0, 6, 4));
  RouteRequest request = Request(map.Snapshot());
  request.target_O = Vec3(10, 0, 1.2);
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_EQ(result.end, RouteEnd::kUnknownSpace);
  const double stop = result.trajectory->end_point().x();
  EXPECT_LT(stop, 3.0 - config.known_free_floor);
  EXPECT_GT(stop, 2.4);
  EXPECT_GT(result.length, 9.0);  // the plan itself goes on, optimistically
}

TEST(RoutePlanner, CreepsWhereLessThanTheHullWasSeenFree) {
  tests::SyntheticMap map(kLow, kHigh);
  map.RevealBox(kLow, Vec3(4.0, 6, 4));
  map.RevealBox(Vec3(4.0, -0.2, 1.0),
                Vec3(6.0, 0.2, 1.4));  // a tube: the ball of 0.19 m does not fit with all its cells
  map.RevealBox(Vec3(6.0, -6, 0), kHigh);
  RouteRequest request = Request(map.Snapshot());
  request.target_O = Vec3(10, 0, 1.2);
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_EQ(result.end, RouteEnd::kTarget);
  double fastest_inside = 0.0;
  double fastest = 0.0;
  for (base::Time t = result.trajectory->start(); t < result.trajectory->end(); t += base::Milliseconds(10)) {
    const TrajectoryPoint point = result.trajectory->Sample(t);
    fastest = std::max(fastest, point.v_O.norm());
    if (point.p_O.x() > 4.1 && point.p_O.x() < 5.9) fastest_inside = std::max(fastest_inside, point.v_O.norm());
  }
  EXPECT_GT(fastest, 1.5);
  EXPECT_GT(fastest_inside, 0.1);
  EXPECT_LT(fastest_inside, config.creep_speed + 0.05);
}

TEST(RoutePlanner, EndsBehindAPassageFromWhichNoWayIsKnown) {
  tests::SyntheticMap map(kLow, kHigh);
  const Passage first{.gate = 0, .X_OG = GateAt(4, 0, 1.5, 0.0), .half_opening = 0.7};
  const Passage second{.gate = 1, .X_OG = GateAt(9, 0, 1.5, 0.0), .half_opening = 0.7};
  map.AddGate(first.X_OG, 1.4);
  map.AddBox({base::Quat::Identity(), second.X_OG * Vec3(-1.2, 0, 0)}, {0.3, 0.3, 0.3});  // where it is entered
  map.RevealAll();
  RouteRequest request = Request(map.Snapshot());
  request.passages = {first, second};
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_EQ(result.end, RouteEnd::kNoWayOn);
  EXPECT_NE(result.reason.find("gate 1: the goal is"), std::string::npos) << result.reason;
  EXPECT_LT((result.trajectory->end_point() - first.X_OG * Vec3(config.passage_after, 0, 0)).norm(), 0.3);
}

TEST(RoutePlanner, SaysWhyItCannot) {
  tests::SyntheticMap map(kLow, kHigh);
  map.AddBox({base::Quat::Identity(), {5, 0, 2}}, {0.2, 6.1, 2.6});
  map.RevealAll();
  RouteRequest request = Request(map.Snapshot());
  request.target_O = Vec3(10, 0, 1.2);
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  EXPECT_FALSE(result.ok);
  EXPECT_NE(result.reason.find("no path"), std::string::npos) << result.reason;
}

TEST(RoutePlanner, SeesThatTheNewMapBlocksTheTrajectory) {
  tests::SyntheticMap map(kLow, kHigh);
  map.RevealAll();
  RouteRequest request = Request(map.Snapshot());
  request.target_O = Vec3(8, 0, 1.2);
  const RouteConfig config;
  const auto planner = MakeInformedRrtStarPlanner(config.planner);
  const RouteResult result = PlanRoute(request, config, *planner);
  ASSERT_TRUE(result.ok);
  EXPECT_FALSE(FirstBlocked(*result.trajectory, base::Time{}, *request.field, {}, config));
  map.AddBox({base::Quat::Identity(), {5, 0, 1}}, {0.2, 0.4, 1.0});
  map.RevealAll();
  const auto blocked = FirstBlocked(*result.trajectory, base::Time{}, *map.Snapshot(), {}, config);
  ASSERT_TRUE(blocked);
  EXPECT_NEAR(result.trajectory->Sample(*blocked).p_O.x(), 4.8 - config.clearance_floor, 0.15);
}

}  // namespace
}  // namespace alula::stack::planning
