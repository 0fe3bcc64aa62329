#include "sim/sensors/imu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/physics_world.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

using base::Vec3;
constexpr base::Duration kStep = base::Milliseconds(1);

ImuConfig Ideal() {
  ImuConfig config;
  config.noise = {};
  return config;
}

TEST(Imu, StandstillReadsPlusG) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 0.1}));
  ImuConfig config = Ideal();
  config.position = {0.03, -0.02, 0.01};
  Imu imu(config, kStep, 1, "imu");
  imu.Settle(physics.state());
  for (int i = 0; i < 3000; ++i) {
    const vehicles::BodyState before = physics.state();
    physics.Step({}, kStep);
    imu.Integrate(before, physics.state());
    if (i < 500 || i % 5 != 0) continue;
    const stack::ImuSample sample = imu.Sample();
    ASSERT_LT((sample.specific_force - Vec3(0, 0, base::kGravity)).norm(), 0.02) << i;
    ASSERT_LT(sample.angular_velocity.norm(), 1e-4) << i;
  }
}

TEST(Imu, FreeFallReadsNothing) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 9}));
  Imu imu(Ideal(), kStep, 1, "imu");
  imu.Settle(physics.state());
  for (int i = 0; i < 400; ++i) {
    const vehicles::BodyState before = physics.state();
    physics.Step({}, kStep);
    imu.Integrate(before, physics.state());
  }
  EXPECT_LT(imu.Sample().specific_force.norm(), 1e-9);
}

TEST(Imu, LeverArmFeelsCentripetalForce) {
  ImuConfig config = Ideal();
  config.position = {0.1, 0, 0};
  Imu imu(config, kStep, 1, "imu");
  const double w = 4.0;  // rad/s about z: the lever arm is pulled inwards by w² r
  const auto state = [&](int i) {
    return vehicles::BodyState{{base::FromYaw(w * i * 1e-3), Vec3::Zero()}, Vec3::Zero(), {0, 0, w}};
  };
  imu.Settle(state(0));
  for (int i = 0; i < 1000; ++i) imu.Integrate(state(i), state(i + 1));
  const stack::ImuSample sample = imu.Sample();
  EXPECT_NEAR(sample.specific_force.x(), -w * w * 0.1, 1e-4);
  EXPECT_NEAR(sample.specific_force.y(), 0.0, 0.01);  // half a step of rotation between mean and end attitude
  EXPECT_NEAR(sample.specific_force.z(), base::kGravity, 1e-12);
  EXPECT_NEAR(sample.angular_velocity.z(), w, 1e-12);
}

TEST(Imu, DelayIsThatOfItsFilter) {
  Imu imu(Ideal(), kStep, 1, "imu");
  vehicles::BodyState before, after;
  imu.Settle(before);
  // A ramp of angular velocity comes out later by the group delay.
  const double slope = 2.0;
  for (int i = 0; i < 2000; ++i) {
    before.w_B.z() = slope * i * 1e-3;
    after.w_B.z() = slope * (i + 1) * 1e-3;
    imu.Integrate(before, after);
  }
  const double lag = 2.0 - imu.Sample().angular_velocity.z() / slope;
  EXPECT_NEAR(lag, imu.delay().Seconds(), 1e-7);
}

TEST(Imu, SaturatesAtItsRange) {
  ImuConfig config = Ideal();
  config.noise.gyro_range = 10.0;
  config.noise.accelerometer_range = 20.0;
  Imu imu(config, kStep, 1, "imu");
  vehicles::BodyState state;
  state.w_B = {50, -50, 0};
  imu.Settle(state);
  for (int i = 0; i < 100; ++i) imu.Integrate(state, state);
  EXPECT_EQ(imu.Sample().angular_velocity, Vec3(10, -10, 0));
}

/// Overlapping Allan deviation of one axis for clusters of m samples (IEEE Std 952, eq. C.17 on integrated samples).
double AllanDeviation(const std::vector<double>& samples, double period, std::size_t m) {
  std::vector<double> theta(samples.size() + 1, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) theta[i + 1] = theta[i] + samples[i] * period;
  const double tau = static_cast<double>(m) * period;
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t k = 0; k + 2 * m < theta.size(); ++k, ++n) {
    const double d = theta[k + 2 * m] - 2.0 * theta[k + m] + theta[k];
    sum += d * d;
  }
  return std::sqrt(sum / (2.0 * tau * tau * static_cast<double>(n)));
}

/// Mean over the three axes of the deviation at `tau`, for the gyro or the accelerometer, over `seconds` of rest.
double MeanDeviation(const ImuConfig& config, bool gyro, double tau, int seconds) {
  Imu imu(config, kStep, 7, "allan");
  imu.Settle({});
  const int n = seconds * 200;
  std::vector<double> axis[3];
  for (int i = 0; i < n; ++i) {
    const stack::ImuSample sample = imu.Sample();
    const Vec3& v = gyro ? sample.angular_velocity : sample.specific_force;
    for (int k = 0; k < 3; ++k) axis[k].push_back(v[k]);
  }
  double variance = 0.0;
  for (const auto& samples : axis) {
    variance += std::pow(AllanDeviation(samples, 1.0 / 200.0, static_cast<std::size_t>(std::lround(tau * 200))), 2) / 3;
  }
  return std::sqrt(variance);
}

// White noise of density N: σ(τ) = N/√τ. With 1800 s and τ = 1 s over three axes about 3·1800/2 independent clusters:
// 1σ of the estimate is about 1.5 %, so 10 % is far away.
TEST(Imu, AllanDeviationOfWhiteNoise) {
  ImuConfig config;
  config.noise.gyro_bias_walk = 0;
  config.noise.accelerometer_bias_walk = 0;
  EXPECT_NEAR(MeanDeviation(config, true, 1.0, 1800) / config.noise.gyro_noise, 1.0, 0.1);
  EXPECT_NEAR(MeanDeviation(config, false, 1.0, 1800) / config.noise.accelerometer_noise, 1.0, 0.1);
}

// Random walk of density K: σ(τ) = K √(τ/3). White noise off; τ = 10 s of 7200 s over three axes: 1σ about 2.5 %.
TEST(Imu, AllanDeviationOfBiasWalk) {
  ImuConfig config;
  config.noise.gyro_noise = 0;
  config.noise.accelerometer_noise = 0;
  const double root = std::sqrt(10.0 / 3.0);
  EXPECT_NEAR(MeanDeviation(config, true, 10.0, 7200) / (config.noise.gyro_bias_walk * root), 1.0, 0.1);
  EXPECT_NEAR(MeanDeviation(config, false, 10.0, 7200) / (config.noise.accelerometer_bias_walk * root), 1.0, 0.1);
}

}  // namespace
}  // namespace alula::sim
