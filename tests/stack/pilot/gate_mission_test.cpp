#include "stack/pilot/gate_mission.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/stack/pilot/toy_course.h"

namespace alula::stack::pilot {
namespace {

using base::Transform;
using base::Vec3;
using tests::Fly;
using tests::ToyCourse;
using tests::ToyResult;

void ExpectAllPassed(const ToyResult& result, double offset) {
  for (const double off : result.gate_offset) {
    EXPECT_GE(off, 0.0);
    EXPECT_LT(off, offset);
  }
  EXPECT_EQ(result.state, StackState::kDone);
}

/// The survey's error: 0.5 m in the opening's plane and 8°.
void SpoilHints(ToyCourse& course, double error, std::uint64_t seed) {
  base::RandomStream random(seed, "hints");
  for (GateHint& gate : course.mission.gates) {
    const double angle = random.Uniform(-M_PI, M_PI);
    const Vec3 in_plane(0.0, error * std::cos(angle), error * std::sin(angle));
    gate.X_WG = gate.X_WG * Transform{base::FromYaw(random.Uniform(-0.14, 0.14)), in_plane};
  }
}

TEST(GateMission, FliesAllFiveGates) {
  const ToyCourse course = ToyCourse::Courtyard();
  const ToyResult result = Fly(course);
  SCOPED_TRACE(result.Log());
  ExpectAllPassed(result, 0.15);
  EXPECT_EQ(result.Count("gate_passed"), 5);
  EXPECT_GT(result.smallest_clearance, 0.2);
  EXPECT_LT((result.end_O - course.mission.target).norm(), 0.3);
  EXPECT_GT(result.length / result.duration, 1.5) << "mean speed over the course";
  EXPECT_FALSE(result.unknown_entered);
}

TEST(GateMission, PassesAtTheMeasuredPlacesWhenTheListIsWrong) {
  for (const std::uint64_t seed : {1, 2}) {
    ToyCourse course = ToyCourse::Courtyard();
    SpoilHints(course, 0.5, seed);
    const ToyResult result = Fly(course, seed);
    SCOPED_TRACE(result.Log());
    ExpectAllPassed(result, 0.2);
    EXPECT_GT(result.smallest_clearance, 0.2);
  }
}

TEST(GateMission, PassesAtTheListedPlacesWhenToldToTrustThem) {
  ToyCourse course = ToyCourse::Courtyard();
  SpoilHints(course, 0.5, 1);
  course.config.trust_gate_list = true;
  const ToyResult result = Fly(course);
  SCOPED_TRACE(result.Log());
  // It flies by the list: half a metre off the first gate's middle in its plane (0.35 … 0.5 along the larger axis).
  ASSERT_GE(result.gate_offset[0], 0.0);
  EXPECT_GT(result.gate_offset[0], 0.3);
  EXPECT_LT(result.gate_offset[0], 0.6);
  EXPECT_LT(result.smallest_clearance, 0.35);
}

TEST(GateMission, SaysThatItDoesNotSeeAGateAndEndsByTheList) {
  ToyCourse course = ToyCourse::Courtyard();
  course.blind_to_gates = true;
  course.truth.resize(1);
  course.mission.gates.resize(1);
  course.mission.target = Vec3(-4, -1, 1.5);
  const ToyResult result = Fly(course);
  SCOPED_TRACE(result.Log());
  EXPECT_GE(result.Count("gate_not_seen"), 3);
  EXPECT_EQ(result.Count("gate_from_list"), 1);
  ExpectAllPassed(result, 0.15);
}

TEST(GateMission, GoesOnAfterAShortLossOfOdometry) {
  ToyCourse course = ToyCourse::Courtyard();
  course.lose_odometry_at = 14.0;
  course.lose_for = 1.0;
  const ToyResult result = Fly(course);
  SCOPED_TRACE(result.Log());
  EXPECT_EQ(result.Count("odometry_lost"), 1);
  EXPECT_EQ(result.Count("odometry_back"), 1);
  ExpectAllPassed(result, 0.15);
}

TEST(GateMission, FinishesClimbAndScanThatALossOfOdometryCutShort) {
  for (const double lost_at : {0.8, 4.0}) {  // in the climb, in the scan
    ToyCourse course = ToyCourse::Courtyard();
    course.lose_odometry_at = lost_at;
    course.lose_for = 1.0;
    course.time_limit = 25.0;
    const ToyResult result = Fly(course);
    SCOPED_TRACE(result.Log());
    ASSERT_EQ(result.Count("odometry_back"), 1);
    const auto kind_is = [](const char* kind) { return [kind](const StackEvent& e) { return e.kind == kind; }; };
    const auto back = std::find_if(result.events.begin(), result.events.end(), kind_is("odometry_back"));
    const auto scan = std::find_if(back, result.events.end(), kind_is("scan"));
    const auto begun = std::find_if(back, result.events.end(), kind_is("course"));
    ASSERT_NE(scan, result.events.end());
    ASSERT_NE(begun, result.events.end());
    EXPECT_NE(scan->text.find("1.2 m up"), std::string::npos) << scan->text;
    EXPECT_GT((begun->time - scan->time).Seconds(), 2.0);  // it does look around
  }
}

TEST(GateMission, LandsWhenTheOdometryStaysLost) {
  ToyCourse course = ToyCourse::Courtyard();
  course.lose_odometry_at = 14.0;
  course.lose_for = 100.0;
  const ToyResult result = Fly(course);
  EXPECT_EQ(result.state, StackState::kFailed);
  EXPECT_EQ(result.Count("landing"), 1);
}

TEST(GateMission, IsDeterministic) {
  ToyCourse course = ToyCourse::Courtyard();
  SpoilHints(course, 0.5, 4);
  course.time_limit = 20.0;
  const ToyResult a = Fly(course);
  const ToyResult b = Fly(course);
  EXPECT_EQ(a.end_O, b.end_O);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.events.size(), b.events.size());
}

}  // namespace
}  // namespace alula::stack::pilot
