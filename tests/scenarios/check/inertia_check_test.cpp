// Each quantity of the inertial unit is found where it is right, and found out where it is not.
#include "scenarios/check/inertia_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "scenarios/check/allan.h"
#include "scenarios/check/statistics.h"
#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;

/// A unit whose walk rises over its noise within a second, so that ten minutes are enough.
sim::ImuConfig Lively() {
  sim::ImuConfig imu;
  imu.rate = {100, 1};
  imu.bandwidth = 40.0;
  imu.noise.gyro_bias_walk = 3e-4;
  imu.orientation = {0.5, -0.2, 0.1};
  imu.position = {0.03, -0.02, 0.01};
  return imu;
}

Rig RigWith(const sim::ImuConfig& imu) {
  Rig rig = testing::EmptyRig();
  rig.sensors.imu = imu;
  return rig;
}

TEST(Allan, FindsTheDensitiesOfASyntheticSignal) {
  // The errors that the fit states for itself are those that it makes: over 40 signals the squares of error/sigma have
  // a mean of 1 ± √(2/40); neighbouring clusters share samples, which lets the stated ones be off by half.
  constexpr double kRate = 50.0, kWhite = 2e-3, kWalk = 4e-3;
  double white = 0.0, walk = 0.0;
  constexpr int kSignals = 40;
  for (int n = 0; n < kSignals; ++n) {
    base::RandomStream random(static_cast<std::uint64_t>(n), "test/allan");
    std::vector<double> signal;
    double bias = 0.0;
    for (int i = 0; i < 10'000; ++i) {
      signal.push_back(bias + kWhite * std::sqrt(kRate) * random.Gaussian());
      bias += kWalk / std::sqrt(kRate) * random.Gaussian();
    }
    const NoiseDensities found = FitAllan(AllanCurve({signal}), 1.0 / kRate);
    white += std::pow((found.white - kWhite) / found.white_sigma, 2) / kSignals;
    walk += std::pow((found.walk - kWalk) / found.walk_sigma, 2) / kSignals;
  }
  EXPECT_GT(white, 0.3);
  EXPECT_LT(white, 2.2);
  EXPECT_GT(walk, 0.3);
  EXPECT_LT(walk, 2.2);
}

TEST(InertiaCheck, NoiseIsFoundAndFoundOut) {
  const sim::ImuConfig claimed = Lively();
  Report right;
  CheckInertiaAtRest(RigWith(claimed), claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::ImuConfig built = claimed;
  built.noise.gyro_noise *= 1.1;
  built.noise.accelerometer_bias_walk *= 1.3;
  Report wrong;
  CheckInertiaAtRest(RigWith(built), claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"gyro noise density (Allan)", "accelerometer bias walk (Allan)"})) << ToTable(wrong);
}

TEST(InertiaCheck, TurnOnBias) {
  const sim::ImuConfig claimed = Lively();
  Report right;
  CheckTurnOnBias(RigWith(claimed), claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::ImuConfig built = claimed;
  built.noise.gyro_turn_on_bias *= 1.2;
  built.noise.accelerometer_turn_on_bias *= 0.8;
  Report wrong;
  CheckTurnOnBias(RigWith(built), claimed, wrong);
  EXPECT_EQ(Failed(wrong).size(), 2U) << ToTable(wrong);
}

TEST(InertiaCheck, MountAndSaturation) {
  const sim::ImuConfig claimed = Lively();
  Report right;
  CheckInertiaInMotion(RigWith(claimed), claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::ImuConfig built = claimed;
  built.orientation[0] += 0.001;  // 0.06 deg
  built.position[2] += 0.003;
  built.noise.gyro_range *= 0.9;
  Report wrong;
  CheckInertiaInMotion(RigWith(built), claimed, wrong);
  const Names failed = Failed(wrong);
  EXPECT_TRUE(failed.contains("mount yaw")) << ToTable(wrong);
  EXPECT_TRUE(failed.contains("position z"));
  EXPECT_TRUE(failed.contains("gyro saturation"));
  EXPECT_FALSE(failed.contains("gyro stamps' offset"));
}

TEST(InertiaCheck, StampsThatAreAMillisecondLateAreFoundOut) {
  Rig rig = RigWith(Lively());
  std::vector<stack::Measurement> samples = Record(rig, nullptr, Shaken, base::Seconds(5.2));
  for (stack::Measurement& m : samples) m.captured += base::Milliseconds(1);
  const InertialFit fit = FitMotion(samples, Shaken);
  EXPECT_NEAR(fit.gyro_offset, -1e-3, 5e-5);
  EXPECT_NEAR(fit.accelerometer_offset, -1e-3, 5e-5);
}

}  // namespace
}  // namespace alula::scenarios::check
