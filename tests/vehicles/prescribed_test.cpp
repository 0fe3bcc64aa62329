#include "vehicles/prescribed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "vehicles/b_spline.h"
#include "vehicles/flatness.h"
#include "vehicles/prescribed_motion.h"

namespace alula::vehicles {
namespace {

using base::Vec3;

PathMotion Loop() { return {.waypoints = {{0, 0, 1}, {6, 0, 1.5}, {6, 5, 2}, {0, 5, 1.2}, {0, 0, 1}}}; }

SineMotion Sines() {
  return {.start = {0, 0, 1.5},
          .terms = {{.amplitude = {2, 1, 0.3}, .frequency = 0.2, .phase = {0, 1, 2}},
                    {.amplitude = {0.3, 0.2, 0.1}, .frequency = 0.5, .phase = {0.5, 0, 0}}},
          .yaw = 0.4,
          .yaw_amplitude = 0.8,
          .ramp = 3,
          .flight_time = 20};
}

std::vector<PrescribedConfig> Configs() {
  std::vector<PrescribedConfig> all;
  for (const MotionConfig& motion : {MotionConfig(Loop()), MotionConfig(Sines())}) {
    all.push_back({.standstill = 2, .motion = motion, .attitude = ThrustAttitude{}, .body = {}});
    all.push_back({.standstill = 2, .motion = motion, .attitude = SineAttitude{}, .body = {}});
  }
  return all;
}

TEST(Prescribed, VelocityAndRatesAreTheDerivativesOfThePose) {
  const base::Duration h = base::Microseconds(500);
  for (const PrescribedConfig& config : Configs()) {
    const auto vehicle = MakePrescribed(config, "vehicle0");
    for (base::Time t{}; t < *vehicle->PrescribedEnd(); t += base::Milliseconds(37)) {
      const BodyState a = vehicle->Prescribed(t), s = vehicle->Prescribed(t + h), b = vehicle->Prescribed(t + h + h);
      const double span = 2 * h.Seconds();
      // Central differences: error h² f‴ / 6, f‴ below 50 m/s³ and 100 rad/s³.
      EXPECT_LT(((b.X_WB.p - a.X_WB.p) / span - s.v_WB).norm(), 5e-6);
      EXPECT_LT((base::Log(a.X_WB.q.conjugate() * b.X_WB.q) / span - s.w_B).norm(), 2e-5) << t.Seconds();
    }
  }
}

TEST(Prescribed, RotorsTurnAsTheMotionWantsThem) {
  PrescribedConfig config{.standstill = 2, .motion = Sines(), .attitude = ThrustAttitude{}, .body = {}};
  EXPECT_TRUE(MakePrescribed(config, "vehicle0")->Rotors().empty());
  config.rotors_turn = true;
  const auto vehicle = MakePrescribed(config, "vehicle0");
  const base::Duration h = base::Milliseconds(1);
  double least = 1e9, most = 0.0;
  for (base::Time t{}; t < *vehicle->PrescribedEnd(); t += h) {
    vehicle->Step(vehicle->Prescribed(t), {}, Vec3::Zero(), h);
    ASSERT_EQ(vehicle->Rotors().size(), 4U);
    double lift = 0.0;
    for (const RotorState& rotor : vehicle->Rotors()) lift += rotor.thrust;
    if (t.Seconds() < 1.9) {
      EXPECT_NEAR(lift, config.body.mass * base::kGravity, 1e-9);
    }
    least = std::min(least, lift);
    most = std::max(most, lift);
    const RotorState& rotor = vehicle->Rotors()[0];
    EXPECT_NEAR(ThrustConstant(config.body.rotor, config.body.air_density) * rotor.speed * rotor.speed, rotor.thrust,
                1e-9);
  }
  EXPECT_LT(least, 0.95 * config.body.mass * base::kGravity);
  EXPECT_GT(most, 1.1 * config.body.mass * base::kGravity);
}

TEST(Prescribed, MotionIsFourTimesSmooth) {
  // Acceleration and jerk as stated are the derivatives of velocity and acceleration, and the jerk has no corners:
  // its second difference over h shrinks with h².
  for (const MotionConfig& config : {MotionConfig(Loop()), MotionConfig(Sines())}) {
    const PrescribedMotion motion(config, "vehicle0");
    const double h = 1e-4;
    for (double t = -0.5; t < motion.duration() + 0.5; t += 0.013) {
      const MotionSample a = motion.At(t - h), s = motion.At(t), b = motion.At(t + h);
      EXPECT_LT(((b.v - a.v) / (2 * h) - s.a).norm(), 1e-5);
      EXPECT_LT(((b.a - a.a) / (2 * h) - s.jerk).norm(), 1e-4);
      EXPECT_LT((b.jerk - 2 * s.jerk + a.jerk).norm(), 1e-4);
      EXPECT_NEAR((b.yaw - a.yaw) / (2 * h), s.yaw_rate, 1e-5);
    }
  }
}

TEST(Prescribed, StandsStillBeforeAndAfter) {
  for (const PrescribedConfig& config : Configs()) {
    const auto vehicle = MakePrescribed(config, "vehicle0");
    const base::Time end = *vehicle->PrescribedEnd();
    for (const base::Time t : {base::Time{}, base::Time{} + base::Seconds(2), end, end + base::Seconds(1)}) {
      const BodyState s = vehicle->Prescribed(t);
      EXPECT_LT(s.v_WB.norm(), 1e-12);
      EXPECT_LT(s.w_B.norm(), 1e-12);
    }
    EXPECT_LT((vehicle->Prescribed(base::Time{}).X_WB.q * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-12);
  }
}

TEST(Prescribed, PathKeepsItsSpeedAndLooksWhereItFlies) {
  const PrescribedConfig config{.standstill = 0, .motion = Loop(), .attitude = ThrustAttitude{}, .body = {}};
  const auto vehicle = MakePrescribed(config, "vehicle0");
  const BodyState s = vehicle->Prescribed(base::Time{} + base::Seconds(3.6));  // on the first straight
  EXPECT_NEAR(s.v_WB.norm(), 1.5, 0.05);
  EXPECT_NEAR(base::Yaw(s.X_WB.q), 0.0, 0.05);
  for (base::Time t{}; t < *vehicle->PrescribedEnd(); t += base::Milliseconds(50)) {
    const BodyState b = vehicle->Prescribed(t);
    EXPECT_LT(b.v_WB.norm(), 1.6);
    EXPECT_GE(b.X_WB.p.minCoeff(), -1e-12);  // inside the polygon's hull
    EXPECT_LE(b.X_WB.p.x(), 6 + 1e-12);
  }
}

TEST(Prescribed, RefusesMotionsThatGoNowhere) {
  PrescribedConfig config;
  config.motion = PathMotion{.waypoints = {{1, 1, 1}, {1, 1, 1}}};
  EXPECT_THROW(MakePrescribed(config, "vehicle0"), base::InputError);
  config.motion = PathMotion{};
  EXPECT_THROW(MakePrescribed(config, "vehicle0"), base::InputError);
}

TEST(QuinticSpline, ReproducesPolynomialsOfItsDegree) {
  // Control points that are samples of a linear function give that function, shifted by the support's middle.
  std::vector<double> line;
  for (int i = 0; i < 12; ++i) line.push_back(3.0 * i - 2);
  const QuinticSpline<double> spline(line);
  for (double u = 0; u <= spline.segments(); u += 0.1) {
    EXPECT_NEAR(spline.Derivative(u, 0), 3.0 * (u + 2) - 2, 1e-12);
    EXPECT_NEAR(spline.Derivative(u, 1), 3.0, 1e-12);
    EXPECT_NEAR(spline.Derivative(u, 2), 0.0, 1e-12);
  }
}

TEST(Flatness, ThrustAxisFollowsAccelerationAndGravity) {
  const Vec3 a(2, -1, 0.5);
  const FlatAttitude flat = AttitudeFromThrust(a, Vec3::Zero(), 0.9, 0);
  EXPECT_LT((flat.q_WB * Vec3::UnitZ() - (a + Vec3(0, 0, base::kGravity)).normalized()).norm(), 1e-12);
  EXPECT_NEAR(base::Yaw(flat.q_WB), 0.9, 1e-12);
}

}  // namespace
}  // namespace alula::vehicles
