#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "vehicles/attitude_control.h"
#include "vehicles/land_detector.h"
#include "vehicles/low_pass.h"
#include "vehicles/multicopter_mixer.h"
#include "vehicles/position_control.h"

namespace alula::vehicles {
namespace {

using base::Quat;
using base::Vec3;

class MixerTest : public ::testing::Test {
 protected:
  const QuadrotorLayout layout = LayOutQuadrotor({});
  const MulticopterMixer mixer{layout.rotors, 0.0127};
  static constexpr double kLow = 0.05, kHigh = 6.8;  // N
};

TEST_F(MixerTest, GivesWhatIsAskedWhenItCan) {
  const Vec3 torque(0.05, -0.04, 0.01);
  const auto r = mixer.Mix(7.3, torque, kLow, kHigh);
  const Eigen::Vector4d had = mixer.Wrench(r.thrusts);
  EXPECT_NEAR(had[0], 7.3, 1e-12);
  EXPECT_LT((had.tail<3>() - torque).norm(), 1e-12);
  EXPECT_EQ(r.saturated, Vec3::Zero());
}

TEST_F(MixerTest, SaturationTable) {
  struct Case {
    const char* name;
    double collective;
    Vec3 torque;
    Vec3 saturated;
    bool keeps_tilt;  // roll and pitch torque as asked for
    int collective_moves;
  };
  const Case cases[] = {
      {"roll at idle raises the collective", 0.2, {0.2, 0, 0}, {0, 0, 0}, true, 1},
      {"roll at full thrust lowers it", 27.2, {0.2, 0, 0}, {0, 0, 0}, true, -1},
      {"yaw at full thrust is given up", 27.2, {0, 0, 0.05}, {0, 0, 1}, true, 0},
      {"yaw at idle is given up", 0.2, {0, 0, -0.05}, {0, 0, -1}, true, 0},
      {"roll before yaw", 7.3, {0.6, 0, 0.2}, {0, 0, 1}, true, 0},
      {"too much roll and pitch shrink together", 7.3, {2.0, -2.0, 0}, {1, -1, 0}, false, 1},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const auto r = mixer.Mix(c.collective, c.torque, kLow, kHigh);
    EXPECT_GE(r.thrusts.minCoeff(), kLow);
    EXPECT_LE(r.thrusts.maxCoeff(), kHigh);
    EXPECT_EQ(r.saturated, c.saturated);
    const Eigen::Vector4d had = mixer.Wrench(r.thrusts);
    if (c.keeps_tilt) {
      EXPECT_LT((had.segment<2>(1) - c.torque.head<2>()).norm(), 1e-9);
    }
    // What is had keeps its direction, and is no more than what was asked for.
    EXPECT_LE(std::abs(had[3]), std::abs(c.torque.z()) + 1e-12);
    EXPECT_GE(had.tail<3>().dot(c.torque), -1e-12);
    const double moved = r.collective - c.collective;
    EXPECT_EQ((moved > 1e-9) - (moved < -1e-9), c.collective_moves);
  }
}

TEST(LowPass, PassesConstantsFromTheStartAndHalvesPowerAtTheCutoff) {
  LowPass filter(50, 1000);
  for (int i = 0; i < 10; ++i) EXPECT_LT((filter.Step({1, 2, 3}) - Vec3(1, 2, 3)).norm(), 1e-12);
  LowPass sine(50, 1000);
  double peak = 0;
  for (int i = 0; i < 2000; ++i) {
    const double y = sine.Step({std::sin(2 * M_PI * 50 * i * 1e-3), 0, 0}).x();
    if (i > 1000) peak = std::max(peak, std::abs(y));
  }
  EXPECT_NEAR(peak, M_SQRT1_2, 0.01);  // 20 samples a period miss the peak by up to 1.2 %
}

TEST(AttitudeControl, SmallErrorsGiveProportionalRatesWithYawWeighted) {
  const AttitudeControlConfig c;
  for (const Vec3& error : {Vec3(0.01, 0, 0), Vec3(0, -0.02, 0), Vec3(0, 0, 0.02)}) {
    const Quat q = base::FromYawPitchRoll(0.7, 0.1, -0.2);
    const Vec3 rate = RateSetpoint(c, q, q * base::Exp(error), 0);
    const Vec3 gain(c.attitude_gain, c.attitude_gain, c.yaw_gain);
    EXPECT_LT((rate - gain.cwiseProduct(error)).norm(), 2e-4 * c.attitude_gain);
  }
}

TEST(AttitudeControl, TurnsTheShortWayFromEveryAttitude) {
  base::RandomStream random(1, "attitudes");
  const AttitudeControlConfig c;
  for (int i = 0; i < 20; ++i) {
    Quat q = base::Exp(2.0 * random.GaussianVec3());
    const Quat goal = base::FromYawPitchRoll(random.Uniform(-3, 3), 0.2, -0.1);
    for (int k = 0; k < 6000; ++k) q = (q * base::Exp(1e-3 * RateSetpoint(c, q, goal, 0))).normalized();
    EXPECT_LT(base::Log(q.conjugate() * goal).norm(), 1e-3);
  }
}

TEST(AttitudeControl, AttitudeForThrustPointsThereAndKeepsItsHeading) {
  const Vec3 f(2, -1, 9);
  const Quat q = AttitudeFor(f, 0.8);
  EXPECT_LT((q * Vec3::UnitZ() - f.normalized()).norm(), 1e-12);
  EXPECT_NEAR(base::Yaw(q), 0.8, 1e-12);
}

TEST(PositionControl, LimitsTiltAndThrustAndKeepsTheVertical) {
  const Vec3 f = LimitThrust({20, 0, 9.8}, 0.7, 1.5, 30);
  EXPECT_NEAR(f.z(), 9.8, 1e-12);
  EXPECT_NEAR(std::atan2(f.x(), f.z()), 0.7, 1e-12);
  const Vec3 g = LimitThrust({0, 15, 20}, 1.2, 1.5, 22);
  EXPECT_NEAR(g.norm(), 22, 1e-12);
  EXPECT_NEAR(g.z(), 20, 1e-12);
  EXPECT_NEAR(LimitThrust({0, 0, -5}, 0.7, 1.5, 22).z(), 1.5, 1e-12);
}

TEST(PositionControl, IntegralStopsWhereTheOutputSaturates) {
  PositionControl control{PositionControlConfig{}};
  MotionSetpoint far;
  far.v_OB = {6, 0, 0};
  for (int i = 0; i < 5000; ++i) control.Step(far, Vec3::Zero(), Vec3::Zero(), 20, 2, true, 1e-3);
  EXPECT_LT(control.integral().norm(), 1e-9);  // 30 m/s² wanted, tilt-limited from the first step on
  far.v_OB = {0.2, 0, 0};
  far.position_weight.setZero();
  for (int i = 0; i < 1000; ++i) control.Step(far, Vec3::Zero(), Vec3::Zero(), 20, 2, true, 1e-3);
  EXPECT_NEAR(control.integral().x(), PositionControlConfig{}.velocity_integral * 0.2, 1e-9);
}

TEST(RateControl, IntegralObeysTheMixer) {
  AttitudeControlConfig c;
  c.rate_gain.setZero();
  c.rate_derivative.setZero();
  RateControl control(c, 1000);
  for (int i = 0; i < 100; ++i) control.Step({1, 1, 0}, Vec3::Zero(), {1, 0, 0}, true, 1e-3);
  const Vec3 out = control.Step({1, 1, 0}, Vec3::Zero(), {1, 0, 0}, false, 1e-3);
  EXPECT_EQ(out.x(), 0);
  EXPECT_NEAR(out.y(), 0.1 * c.rate_integral.y(), 1e-9);
}

TEST(LandDetector, NeedsContactThenLowThrust) {
  LandDetector detector{LandDetectorConfig{}};
  detector.SetLanded(false);
  for (int i = 0; i < 3000; ++i) detector.Step(true, 1.0, 1.0, {0, 0, -0.3}, 1e-3);
  EXPECT_FALSE(detector.contact());
  for (int i = 0; i < 400; ++i) detector.Step(true, 0.9, 1.0, {0, 0, 0}, 1e-3);
  EXPECT_TRUE(detector.contact());
  EXPECT_FALSE(detector.landed());
  for (int i = 0; i < 400; ++i) detector.Step(true, 0.1, 1.0, {0, 0, 0}, 1e-3);
  EXPECT_TRUE(detector.landed());
}

TEST(LandDetector, FeelsTheGroundEvenWithAWrongVelocity) {
  LandDetector detector{LandDetectorConfig{}};
  detector.SetLanded(false);
  for (int i = 0; i < 300; ++i) detector.Step(true, 0.4, 1.0, {0, 0, -0.3}, 1e-3);
  EXPECT_TRUE(detector.contact());
  detector.Step(true, 0.4, 0.4, {0, 0, -0.6}, 1e-3);  // nothing carries it after all
  EXPECT_FALSE(detector.contact());
}

}  // namespace
}  // namespace alula::vehicles
