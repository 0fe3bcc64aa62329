#include "stack/pilot/flown_trajectory.h"

#include <gtest/gtest.h>

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;
using planning::Trajectory;

const planning::TrajectoryLimits kLimits;

TEST(FlownTrajectory, AQueuedTrajectoryTakesOverAtItsStart) {
  FlownTrajectory flown(kLimits);
  EXPECT_FALSE(flown.flying());
  flown.Replace(Trajectory::Hover(Time{}, Vec3(1, 0, 0), 0.0));
  const auto generation = flown.generation();
  const Time start = Time{} + Milliseconds(120);
  flown.Queue(Trajectory::Hover(start, Vec3(2, 0, 0), 0.0));
  flown.TakeOver(start - Milliseconds(1));
  EXPECT_TRUE(flown.waiting());
  EXPECT_EQ(flown.Sample(start).p_O, Vec3(1, 0, 0));
  flown.TakeOver(start);
  EXPECT_FALSE(flown.waiting());
  EXPECT_EQ(flown.Sample(start).p_O, Vec3(2, 0, 0));
  EXPECT_EQ(flown.generation(), generation) << "routes asked for meanwhile still count";
}

TEST(FlownTrajectory, ABrakeOrATurnDropsWhatWaitsAndOutdatesWhatWasAskedFor) {
  FlownTrajectory flown(kLimits);
  flown.Replace(Trajectory::Hover(Time{}, Vec3(1, 0, 0), 0.0));
  flown.Queue(Trajectory::Hover(Time{} + Milliseconds(100), Vec3(2, 0, 0), 0.0));
  auto generation = flown.generation();
  flown.Brake(Time{}, {.p_O = Vec3(1, 0, 0), .v_O = Vec3(1, 0, 0)});
  EXPECT_FALSE(flown.waiting());
  EXPECT_GT(flown.generation(), generation);
  // 1 m/s at 3 m/s²: v²/2a = 0.17 m; the trajectory answers a knot or two later.
  const double way = flown.current().end_point().x() - 1.0;
  EXPECT_GE(way, 1.0 / 6.0);
  EXPECT_LT(way, 1.0 / 6.0 + 2 * kLimits.knot_period);

  flown.Queue(Trajectory::Hover(Time{} + Milliseconds(100), Vec3(2, 0, 0), 0.0));
  generation = flown.generation();
  flown.Turn(Time{}, {0.5, 0.0}, 1.2);
  EXPECT_FALSE(flown.waiting());
  EXPECT_GT(flown.generation(), generation);
}

TEST(FlownTrajectory, TurnsUntilTheLastHeadingAndNoLonger) {
  FlownTrajectory flown(kLimits);
  flown.Replace(Trajectory::Hover(Time{}, Vec3(1, 2, 3), 0.2));
  EXPECT_FALSE(flown.Turning(Time{}));
  flown.Turn(Time{}, {0.8, -0.4}, 1.2);
  const Time end = flown.current().yaw_end();
  EXPECT_GT((end - Time{}).Seconds(), (0.6 + 1.2) / 1.2) << "no faster than the rate allows";
  EXPECT_TRUE(flown.Turning(end - Milliseconds(1)));
  EXPECT_FALSE(flown.Turning(end));
  EXPECT_EQ(flown.Sample(end).p_O, Vec3(1, 2, 3));
  EXPECT_NEAR(flown.Sample(end).yaw, -0.4, 0.02);  // the yaw filter's settled band

  flown.Turn(end, {0.0}, 1.2);
  flown.Brake(end, {.p_O = Vec3(1, 2, 3)});
  EXPECT_FALSE(flown.Turning(end)) << "a brake ends a turn";
}

}  // namespace
}  // namespace alula::stack::pilot
