// Every error of imu_errors.h against its closed form.
#include "sim/sensors/imu_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/config.h"
#include "sim/sensors/imu.h"

namespace alula::sim {
namespace {

using base::Mat3;
using base::Vec3;
constexpr base::Duration kStep = base::Milliseconds(1);

ImuConfig Ideal() {
  ImuConfig config;
  config.noise = {};
  config.errors.emplace();
  return config;
}

/// What it reads at rest in this state, for ever.
stack::ImuSample ReadSteady(const ImuConfig& config, const vehicles::BodyState& state) {
  Imu imu(config, kStep, 1, "imu");
  imu.Settle(state);
  return imu.Sample();
}

TEST(ImuErrors, NoneChangesNothing) {
  ImuConfig with;
  with.errors.emplace();
  Imu plain(ImuConfig{}, kStep, 3, "imu"), same(with, kStep, 3, "imu");
  const vehicles::BodyState state{{base::FromYawPitchRoll(0.3, 0.2, -0.1), Vec3::Zero()}, Vec3::Zero(), {0.1, 0.2, 3}};
  plain.Settle(state);
  same.Settle(state);
  for (int i = 0; i < 100; ++i) {
    const stack::ImuSample a = plain.Sample(), b = same.Sample();
    ASSERT_EQ(a.angular_velocity, b.angular_velocity);
    ASSERT_EQ(a.specific_force, b.specific_force);
  }
}

TEST(ImuErrors, ScaleAxesAndGSensitivityAreLinear) {
  ImuConfig config = Ideal();
  config.errors->gyro.scale = {0.01, -0.02, 0.03};
  config.errors->gyro.nonorthogonality = {1e-3, 2e-3, 3e-3};
  config.errors->accelerometer.scale = {0.0, 0.0, 0.005};
  config.errors->accelerometer.misalignment = {0.01, 0.0, 0.0};
  config.errors->g_sensitivity_x = {1e-4, 2e-4, 3e-4};
  const Vec3 w(1.0, 2.0, -1.0);
  const stack::ImuSample read = ReadSteady(config, {{base::Quat::Identity(), Vec3::Zero()}, Vec3::Zero(), w});
  const Vec3 sheared(w.x(), w.y() + 1e-3 * w.x(), w.z() + 2e-3 * w.x() + 3e-3 * w.y());
  const Vec3 expected(1.01 * sheared.x() + 3e-4 * base::kGravity, 0.98 * sheared.y(), 1.03 * sheared.z());
  EXPECT_LT((read.angular_velocity - expected).norm(), 1e-12);
  // A triad turned by +m about x reads what points up rotated by −m.
  const Vec3 f(0.0, std::sin(0.01) * base::kGravity, 1.005 * std::cos(0.01) * base::kGravity);
  EXPECT_LT((read.specific_force - f).norm(), 1e-12);
}

TEST(ImuErrors, WarmsUpExponentially) {
  ImuConfig config = Ideal();
  config.errors->temperature = {.ambient = 10.0, .rise = 20.0, .time_constant = 30.0, .powered_for = 5.0};
  config.errors->gyro.bias_per_kelvin = {1e-3, 0.0, -1e-3};
  config.errors->accelerometer.scale_per_kelvin = {0.0, 0.0, 1e-4};
  Imu imu(config, kStep, 1, "imu");
  imu.Settle({});
  for (int i = 0; i <= 200 * 40; ++i) {  // at 200 Hz: 40 s
    const double T = 10.0 + 20.0 * (1.0 - std::exp(-(i / 200.0 + 5.0) / 30.0));
    EXPECT_NEAR(imu.gyro_bias().x(), 1e-3 * T, 1e-12);
    const stack::ImuSample read = imu.Sample();
    ASSERT_NEAR(read.angular_velocity.x(), 1e-3 * T, 1e-12);
    ASSERT_NEAR(read.angular_velocity.z(), -1e-3 * T, 1e-12);
    ASSERT_NEAR(read.specific_force.z(), base::kGravity * (1.0 + 1e-4 * T), 1e-11);
  }
}

TEST(ImuErrors, ReadsWholeQuanta) {
  ImuConfig config = Ideal();
  config.errors->gyro.quantum = 0.01;
  config.errors->accelerometer.quantum = 0.5;
  const stack::ImuSample read =
      ReadSteady(config, {{base::Quat::Identity(), Vec3::Zero()}, Vec3::Zero(), {0.016, -0.004, 0.014}});
  EXPECT_LT((read.angular_velocity - Vec3(0.02, 0.0, 0.01)).norm(), 1e-15);
  EXPECT_EQ(read.specific_force, Vec3(0.0, 0.0, 10.0));  // 9.81
}

/// Amplitude and phase of the n-th harmonic in samples taken at these angles, by projection.
std::complex<double> Harmonic(const std::vector<double>& samples, const std::vector<double>& angles, int n) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) sum += samples[i] * std::polar(1.0, -n * angles[i]);
  return 2.0 * sum / static_cast<double>(samples.size());
}

// At 1000 rad/s three blades pass at 477 Hz, which sampling at 200 Hz folds: with the angle known, the projection does
// not care. 5 s are 1000 samples; 1000 rad/s is no multiple of the rate, so other harmonics leave 1/1000 at most.
TEST(ImuErrors, VibrationHasTheFiltersGainAtTheTrueFrequency) {
  ImuConfig config = Ideal();
  config.errors->vibration = RotorVibrationConfig{.blades = 3,
                                                  .reference_speed = 500.0,
                                                  .imbalance = 0.5,
                                                  .blade_pass = 0.8,
                                                  .gyro_imbalance = 0.02,
                                                  .gyro_blade_pass = 0.01};
  for (const double speed : {500.0, 1000.0, 1730.0}) {
    Imu imu(config, kStep, 1, "imu");
    imu.Settle({});
    const std::vector<vehicles::RotorState> rotors{{.speed = speed, .spin = -1.0}};
    std::vector<double> x, y, z, wx, angles;
    for (int i = 1; i <= 5000; ++i) {
      imu.Integrate({}, {}, rotors);
      if (i % 5 != 0) continue;
      const stack::ImuSample read = imu.Sample();
      x.push_back(read.specific_force.x());
      y.push_back(read.specific_force.y());
      z.push_back(read.specific_force.z() - base::kGravity);
      wx.push_back(read.angular_velocity.x());
      angles.push_back(std::fmod(speed * 1e-3 * i, 2.0 * std::numbers::pi));
    }
    const auto gain = [](double w) {
      const double u = w / (2.0 * std::numbers::pi * 90.0);
      return 1.0 / std::sqrt(1.0 + u * u * u * u);
    };
    const double ratio = speed / 500.0;
    const std::complex<double> along_x = Harmonic(x, angles, 1), along_y = Harmonic(y, angles, 1);
    EXPECT_NEAR(std::abs(along_x), 0.5 * ratio * ratio * gain(speed), 0.01);
    EXPECT_LT(std::abs(along_y - along_x * std::complex<double>(0.0, 1.0)), 0.01);  // spin −1: y leads x
    EXPECT_NEAR(std::abs(Harmonic(z, angles, 3)), 0.8 * ratio * ratio * gain(3.0 * speed), 0.01);
    EXPECT_NEAR(std::abs(Harmonic(wx, angles, 1)), 0.02 * ratio * gain(speed), 5e-4);
    EXPECT_NEAR(std::abs(Harmonic(wx, angles, 3)), 0.01 * ratio * gain(3.0 * speed), 5e-4);
  }
}

TEST(ImuErrors, StillRotorsDoNotShake) {
  ImuConfig config = Ideal();
  config.errors->vibration = RotorVibrationConfig{.imbalance = 5.0, .blade_pass = 5.0, .gyro_imbalance = 1.0};
  Imu imu(config, kStep, 1, "imu");
  imu.Settle({});
  const std::vector<vehicles::RotorState> rotors(4);
  for (int i = 0; i < 10; ++i) imu.Integrate({}, {}, rotors);
  EXPECT_LT((imu.Sample().specific_force - Vec3(0, 0, base::kGravity)).norm(), 1e-12);
}

TEST(ImuErrors, ReadInUnitsOfADataSheet) {
  const auto config = base::ReadConfig<ImuConfig>(
      base::YamlDocument::Parse(
          "errors:\n"
          "  gyro: {bias_per_kelvin: [0.005 deg/s/K, 0 deg/s/K, 0 deg/s/K], quantum: 0.04 deg/s}\n"
          "  accelerometer: {scale_per_kelvin: [40 ppm/K, 0 1/K, 0 1/K]}\n"
          "  g_sensitivity_z: [0 deg/s/g0, 0 deg/s/g0, 0.015 deg/s/g0]\n"
          "  temperature: {ambient: -5 K, rise: 12 K}\n"
          "  vibration: {imbalance: 0.1 g0}\n",
          "imu.yaml"),
      1);
  ASSERT_TRUE(config.errors);
  EXPECT_NEAR(config.errors->gyro.bias_per_kelvin.x(), 0.005 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_NEAR(config.errors->accelerometer.scale_per_kelvin.x(), 40e-6, 1e-15);
  EXPECT_NEAR(config.errors->GSensitivity()(2, 2), 0.015 * std::numbers::pi / 180.0 / 9.80665, 1e-12);
  EXPECT_EQ(config.errors->temperature.rise, 12.0);
  EXPECT_NEAR(config.errors->vibration->imbalance, 0.980665, 1e-12);
}

}  // namespace
}  // namespace alula::sim
