// Each error of the inertial unit is found where it is right, and found out where it is not.
#include "scenarios/check/imu_errors_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;

sim::ImuConfig Worn() {
  sim::ImuConfig imu;
  imu.orientation = {0.5, -0.2, 0.1};
  imu.position = {0.03, -0.02, 0.01};
  sim::ImuErrors& e = imu.errors.emplace();
  e.gyro.scale = {5e-3, -8e-3, 3e-3};
  e.gyro.misalignment = {1e-3, 2e-3, -3e-3};
  e.gyro.nonorthogonality = {1e-3, -1e-3, 2e-3};
  e.gyro.bias_per_kelvin = {8e-5, -5e-5, 2e-5};
  e.gyro.scale_per_kelvin = {4e-5, 0.0, -4e-5};
  e.gyro.quantum = 7e-4;
  e.accelerometer.scale = {3e-3, 2e-3, -4e-3};
  e.accelerometer.misalignment = {-2e-3, 0.0, 1e-3};
  e.accelerometer.bias_per_kelvin = {1e-3, 0.0, -2e-3};
  e.accelerometer.scale_per_kelvin = {2e-5, 4e-5, 0.0};
  e.accelerometer.quantum = 8e-3;
  e.g_sensitivity_x = {3e-5, 1e-5, 0.0};
  e.g_sensitivity_z = {0.0, 0.0, -3e-5};
  e.temperature = {.ambient = 5.0, .rise = 15.0, .time_constant = 30.0, .powered_for = 10.0};
  e.vibration =
      sim::RotorVibrationConfig{.imbalance = 1.0, .blade_pass = 2.0, .gyro_imbalance = 0.02, .gyro_blade_pass = 0.03};
  return imu;
}

Report Check(const sim::ImuConfig& built, const sim::ImuConfig& claimed) {
  Rig rig = testing::EmptyRig();
  rig.sensors.imu = built;
  Report report;
  CheckImuErrors(rig, claimed, report);
  return report;
}

TEST(ImuErrorsCheck, FindsAll) {
  const Report report = Check(Worn(), Worn());
  EXPECT_EQ(Failed(report), Names{}) << ToTable(report);
  EXPECT_EQ(report.rows.size(), 49U) << ToTable(report);
}

TEST(ImuErrorsCheck, FindsOut) {
  sim::ImuConfig built = Worn();
  built.errors->gyro.scale.x() += 5e-4;
  built.errors->gyro.misalignment.z() += 5e-4;
  built.errors->gyro.bias_per_kelvin.y() *= 1.1;
  built.errors->gyro.quantum *= 1.01;
  built.errors->accelerometer.nonorthogonality.x() += 2e-3;
  built.errors->accelerometer.scale_per_kelvin.x() *= 1.3;
  built.errors->g_sensitivity_z.z() *= 3.0;
  built.errors->temperature.rise *= 1.1;
  built.errors->vibration->imbalance *= 1.05;
  built.errors->vibration->gyro_blade_pass *= 1.5;
  const Report report = Check(built, Worn());
  const Names failed = Failed(report);
  const Names wanted{"gyro scale x",
                     "gyro misalignment z",
                     "gyro bias per kelvin y",
                     "gyro quantum",
                     "accelerometer nonorthogonality, x in y",
                     "accelerometer scale per kelvin x",
                     "g-sensitivity of gyro z to z",
                     "self-heating",
                     "vibration once a revolution, x",
                     "vibration once a revolution, y",
                     "gyro vibration once a blade, x"};
  EXPECT_TRUE(std::includes(failed.begin(), failed.end(), wanted.begin(), wanted.end())) << ToTable(report);
  EXPECT_FALSE(failed.contains("accelerometer scale z")) << ToTable(report);
  EXPECT_FALSE(failed.contains("warm-up time constant")) << ToTable(report);
}

TEST(ImuErrorsCheck, AnIdealUnitIsNotAWornOne) {
  sim::ImuConfig ideal = Worn();
  ideal.errors.reset();
  EXPECT_GT(Failed(Check(ideal, Worn())).size(), 20U);
}

}  // namespace
}  // namespace alula::scenarios::check
