#include "stack/pilot/flight_watch.h"

#include <gtest/gtest.h>

#include "tests/stack/planning/synthetic_map.h"

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;
using planning::Trajectory;
using planning::TrajectoryPoint;

constexpr double kCell = 0.1;  // m, of the map: what a distance in it may be off by

TEST(FlightWatch, RestEndsWithMotionAndWithTurning) {
  RestWatch rest;
  const TrajectoryPoint here{.p_O = Vec3(3, 0, 1)};
  const TrajectoryPoint near{.p_O = Vec3(3.2, 0, 1)};
  const TrajectoryPoint far{.p_O = Vec3(3.3, 0, 1)};
  const TrajectoryPoint turning{.p_O = Vec3(3.3, 0, 1), .yaw_rate = -0.2};
  const Time start{};
  rest.Update(start, here);
  rest.Update(start + Milliseconds(100), near);
  EXPECT_EQ(rest.Rest(start + Milliseconds(100)), Milliseconds(100));
  rest.Update(start + Milliseconds(200), far);
  EXPECT_EQ(rest.Rest(start + Milliseconds(200)), Milliseconds(0)) << "0.3 m from where the rest began";
  rest.Update(start + Milliseconds(300), far);
  EXPECT_EQ(rest.Rest(start + Milliseconds(300)), Milliseconds(100));
  rest.Update(start + Milliseconds(400), turning);
  EXPECT_EQ(rest.Rest(start + Milliseconds(400)), Milliseconds(0));
  rest.Restart(start + Milliseconds(450));
  EXPECT_EQ(rest.Rest(start + Milliseconds(500)), Milliseconds(50));
}

TEST(FlightWatch, BrakesWhenTheTimeToStopAndToReplanIsAllThatIsLeft) {
  // 1.5 m/s at 3 m/s²: 0.5 s to stop, and 0.45 s for a new route.
  EXPECT_FALSE(TooLateToReplan(0.96, 1.5, 3.0));
  EXPECT_TRUE(TooLateToReplan(0.94, 1.5, 3.0));
  EXPECT_TRUE(TooLateToReplan(0.0, 0.2, 3.0));
  EXPECT_FALSE(TooLateToReplan(0.0, 0.05, 3.0)) << "it hardly moves";
}

TEST(FlightWatch, LooksAtTheMapAlongTheTrajectory) {
  tests::SyntheticMap map(Vec3(-2, -3, 0), Vec3(12, 3, 3));
  map.AddBox({base::Quat::Identity(), {8, 0, 1.2}}, Vec3(0.5, 0.5, 0.5));
  map.RevealAll();
  const auto field = map.Snapshot();
  const planning::RouteConfig config;
  const TrajectoryPoint start{.p_O = Vec3(0, 0, 1.2)};
  const auto into = Trajectory::Along(Time{}, start, planning::Curve({start.p_O, Vec3(9, 0, 1.2)}), {}, config.limits);
  const auto beside =
      Trajectory::Along(Time{}, start, planning::Curve({start.p_O, Vec3(9, 2.5, 1.2)}), {}, config.limits);
  ASSERT_TRUE(into && beside);
  bool braked = false;
  for (Time t{}; t < into->end() && !braked; t += Milliseconds(10)) {
    const TrajectoryPoint point = into->Sample(t);
    braked = MustBrake(*into, t, point, *field, {}, config);
    if (!braked) continue;
    // What is left then: v²/a + 0.45 s · v to the block, more than the v²/2a of braking but not much more.
    const double speed = point.v_O.norm();
    const double to_block = 7.5 - (config.clearance_floor - 0.02) - point.p_O.x();
    EXPECT_GT(to_block, 0.5 * speed * speed / config.limits.max_acceleration);
    EXPECT_LT(to_block, speed * speed / config.limits.max_acceleration + 0.45 * speed + kCell);
  }
  EXPECT_TRUE(braked);
  for (Time t{}; t < beside->end(); t += Milliseconds(50)) {
    EXPECT_FALSE(MustBrake(*beside, t, beside->Sample(t), *field, {}, config)) << t.Seconds();
  }
}

}  // namespace
}  // namespace alula::stack::pilot
