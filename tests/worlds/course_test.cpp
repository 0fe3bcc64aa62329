#include "worlds/course.h"

#include <gtest/gtest.h>

#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;
constexpr double kDegree = 0.017453292519943295;

TEST(Course, NominalCourseKeepsThePromises) {
  CourtyardConfig config;
  config.placement_tries = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_TRUE(IsFlyable(DrawCourse(config, seed))) << seed;
}

TEST(Course, IsHardlyEverTheNominalOne) {
  CourtyardConfig config;
  CourtyardConfig none = config;
  none.placement_tries = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const CoursePlan drawn = DrawCourse(config, seed);
    EXPECT_NE(drawn.gates[2].p, DrawCourse(none, seed).gates[2].p) << seed;
  }
}

/// Written anew from the description of courtyard.h, not from IsFlyable.
TEST(Course, PromisesHoldOverSeeds) {
  const CourtyardConfig config;
  double shortest = 1e9;
  double longest = 0.0;
  int clockwise = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const CoursePlan course = DrawCourse(config, seed);
    const double length = CourseLength(course);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
    double turned = 0.0;
    for (std::size_t i = 0; i < course.gates.size(); ++i) {
      const GatePlan& gate = course.gates[i];
      EXPECT_GE(gate.opening, 1.2);
      EXPECT_LE(gate.opening, 1.6);
      EXPECT_GE(gate.frame, 0.12);
      EXPECT_LE(gate.frame, 0.20);
      EXPECT_GE(gate.height, 1.1);
      EXPECT_LE(gate.height, 2.2);
      EXPECT_GT(gate.height - 0.5 * gate.opening - gate.frame, 0.0);
      if (i == 0) continue;
      const double spacing = (gate.p - course.gates[i - 1].p).norm();
      EXPECT_GE(spacing, 5.0);
      EXPECT_LE(spacing, 9.0);
      const double turn = base::WrapAngle(gate.yaw - course.gates[i - 1].yaw);
      EXPECT_LE(std::abs(turn), 100.0 * kDegree);
      turned += turn;
    }
    clockwise += turned < 0.0 ? 1 : 0;
    EXPECT_GT(std::abs(turned), 90.0 * kDegree);  // a loop
    EXPECT_LE((course.target - course.pad).norm(), 4.0);
    EXPECT_GE(length, 35.0);
    EXPECT_LE(length, 55.0);
  }
  EXPECT_GT(clockwise, 60);
  EXPECT_LT(clockwise, 140);
  RecordProperty("shortest_mm", static_cast<int>(1000 * shortest));
  RecordProperty("longest_mm", static_cast<int>(1000 * longest));
}

TEST(Course, DistanceToSegment) {
  EXPECT_DOUBLE_EQ(DistanceToSegment({0.5, 2.0}, {0.0, 0.0}, {1.0, 0.0}), 2.0);
  EXPECT_DOUBLE_EQ(DistanceToSegment({4.0, 4.0}, {0.0, 0.0}, {1.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(DistanceToSegment({3.0, 4.0}, {0.0, 0.0}, {0.0, 0.0}), 5.0);
}

}  // namespace
}  // namespace alula::worlds
