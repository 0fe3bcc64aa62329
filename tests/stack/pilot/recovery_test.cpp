#include "stack/pilot/recovery.h"

#include <gtest/gtest.h>

#include <cmath>

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;

constexpr double kCreep = 0.6;  // m/s

TEST(Recovery, ConcedesMarginTwiceAndLooksTwiceInTurn) {
  for (int attempt = 0; attempt < 12; ++attempt) {
    SCOPED_TRACE(attempt);
    const WayOut way = WayOutFor(attempt, false, kCreep);
    const bool looks = attempt % 4 == 1 || attempt % 4 == 2;
    EXPECT_EQ(way.scan_half_angle > 0.0, looks);
    EXPECT_EQ(way.concessions.max_speed, looks ? -1.0 : kCreep) << "less margin only where it creeps";
    EXPECT_EQ(way.concessions.clearance_scale < 1.0, !looks);
    EXPECT_EQ(way.concessions.ignore_openings, attempt % 4 == 3) << "only as the last way out";
    EXPECT_EQ(way.concessions.limit_climb, attempt % 4 != 3);
    EXPECT_EQ(way.forget_legs, attempt > 0);
    EXPECT_FALSE(way.remedy.empty());
  }
  EXPECT_GT(WayOutFor(2, false, kCreep).scan_half_angle, M_PI) << "sees what is behind";
}

TEST(Recovery, KeepsItsDistanceToObstaclesWhereOnlyTheUnknownIsInTheWay) {
  EXPECT_EQ(WayOutFor(0, true, kCreep).concessions.clearance_scale, 1.0);
  EXPECT_GE(WayOutFor(0, true, kCreep).concessions.known_free_floor, 0.0);
}

TEST(Recovery, ConcessionsLapse) {
  Recovery recovery;
  const Time start{};
  EXPECT_EQ(recovery.InForce(start).max_speed, -1.0);
  recovery.Next(start, Vec3::Zero(), false, kCreep);
  EXPECT_EQ(recovery.InForce(start + Milliseconds(3499)).max_speed, kCreep);
  EXPECT_EQ(recovery.InForce(start + Milliseconds(3500)).max_speed, -1.0);
  EXPECT_EQ(recovery.InForce(start + Milliseconds(3500)).clearance_scale, 1.0);
}

TEST(Recovery, StartsAnewOnlyAfterProgress) {
  Recovery recovery;
  const Vec3 stuck_O(4.0, 1.0, 1.5);
  EXPECT_FALSE(recovery.Next(Time{}, stuck_O, false, kCreep).forget_legs) << "the first way out";
  recovery.NoteProgress(stuck_O + Vec3(0.69, 0, 0));
  EXPECT_GT(recovery.Next(Time{}, stuck_O, false, kCreep).scan_half_angle, 0.0) << "the second";
  recovery.NoteProgress(stuck_O + Vec3(0.71, 0, 0));
  EXPECT_FALSE(recovery.Next(Time{}, stuck_O, false, kCreep).forget_legs) << "the first again";
}

TEST(Recovery, BelievesTheListAfterSixLooksInVain) {
  for (int look = 1; look <= 8; ++look) {
    SCOPED_TRACE(look);
    EXPECT_EQ(AfterLookInVain(look).believe_list, look >= 6);
    EXPECT_EQ(AfterLookInVain(look).scan_half_angle > 0.0, look < 6 && look % 2 == 1);
  }
}

}  // namespace
}  // namespace alula::stack::pilot
