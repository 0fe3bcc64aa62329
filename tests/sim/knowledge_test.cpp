#include "sim/knowledge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/sensors/suite.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

stack::Calibration Truth() {
  SensorsConfig sensors;
  sensors.stereo = StereoCameraConfig{};
  return TrueCalibration(sensors, testing::PlateOnLegs(), "vehicle0");
}

TEST(Knowledge, TrueCalibrationIsThatOfTheCamera) {
  const stack::Calibration truth = Truth();
  ASSERT_EQ(truth.cameras.size(), 2U);
  const base::Transform X_LR = truth.cameras[0].X_BC.Inverse() * truth.cameras[1].X_BC;
  EXPECT_LT((X_LR.p - base::Vec3(0.11, 0, 0)).norm(), 1e-15);  // the right eye is to the right: along camera x
  EXPECT_NEAR(truth.cameras[0].intrinsics.fx, 320.0 / std::tan(40.0 * M_PI / 180.0), 1e-9);
}

/// Root mean square of each kind of error over many seeds, against what was asked for; 1σ of an RMS over n draws is
/// 1/√(2n) of it: 2000 seeds × 3 axes leave 1 %, so 6 % is far.
TEST(Knowledge, ErrorsHaveTheSizeAskedFor) {
  const stack::Calibration truth = Truth();
  const KnowledgeErrors errors;
  double angle = 0, position = 0, eye = 0, focal = 0, offset = 0;
  constexpr int n = 2000;
  for (int seed = 1; seed <= n; ++seed) {
    const stack::Calibration judged = Misjudge(truth, errors, static_cast<std::uint64_t>(seed));
    const base::Transform& X = judged.cameras[0].X_BC;
    const base::Transform& Y = judged.cameras[1].X_BC;
    angle += base::Log(truth.cameras[0].X_BC.q.conjugate() * X.q).squaredNorm() / 3;
    position += (X.p - truth.cameras[0].X_BC.p).squaredNorm() / 3;
    eye += base::Log(X.q.conjugate() * Y.q).squaredNorm() / 3;
    focal += std::pow(judged.cameras[0].intrinsics.fx / truth.cameras[0].intrinsics.fx - 1.0, 2);
    offset += std::pow(judged.cameras[0].time_offset.Seconds(), 2);
    EXPECT_EQ(judged.cameras[0].intrinsics.fx, judged.cameras[1].intrinsics.fx);
    EXPECT_EQ(judged.cameras[0].time_offset, judged.cameras[1].time_offset);
  }
  EXPECT_NEAR(std::sqrt(angle / n) / errors.extrinsics_angle, 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(position / n) / errors.extrinsics_position, 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(eye / n) / errors.eye_angle, 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(focal / n) / errors.focal, 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(offset / n) / errors.time_offset.Seconds(), 1.0, 0.06);
}

// 2000 seeds leave 1.6 % of an RMS.
TEST(Knowledge, TheFieldThatIsToldHasAnotherDeclination) {
  SensorsConfig sensors;
  sensors.magnetometer = MagnetometerConfig{.orientation = {0.3, 0.0, 0.0}};
  const MagneticFieldConfig field{.intensity = 50e-6, .inclination = 1.0, .declination = 0.1};
  const stack::Calibration truth = TrueCalibration(sensors, testing::PlateOnLegs(), "vehicle0", field);
  ASSERT_TRUE(truth.magnetometer);
  EXPECT_EQ(truth.magnetometer->name, "vehicle0/magnetometer");
  EXPECT_EQ(truth.magnetometer->B_W, FluxDensity(field));
  EXPECT_NEAR(base::Yaw(truth.magnetometer->q_BM), 0.3, 1e-12);
  const auto declination = [](const base::Vec3& B_W) { return std::atan2(B_W.x(), B_W.y()); };
  const KnowledgeErrors errors;
  double squares = 0.0;
  constexpr int n = 2000;
  for (int seed = 1; seed <= n; ++seed) {
    const base::Vec3 B_W = Misjudge(truth, errors, static_cast<std::uint64_t>(seed)).magnetometer->B_W;
    EXPECT_NEAR(B_W.norm(), 50e-6, 1e-18);
    EXPECT_NEAR(B_W.z(), truth.magnetometer->B_W.z(), 1e-18);
    squares += std::pow(declination(B_W) - 0.1, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / n) / errors.declination, 1.0, 0.064);
}

TEST(Knowledge, GateHintsAreWrongInTheirPlaneOnly) {
  worlds::World world = testing::GroundAndCrate();
  world.gates.push_back({"gate0", {base::FromYaw(0.7), {3, 1, 1.5}}, 1.4, 0.15});
  const KnowledgeErrors errors;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const stack::Mission mission = SurveyMission(world, StartPose(world, 0.1), {}, errors, seed);
    const base::Vec3 shift_G = world.gates[0].X_WG.Inverse() * mission.gates[0].X_WG.p;
    EXPECT_NEAR(shift_G.x(), 0.0, 1e-12);
    EXPECT_GE(shift_G.norm(), 0.3 - 1e-12);
    EXPECT_LE(shift_G.norm(), 0.6 + 1e-12);
    const double turn = base::WrapAngle(base::Yaw(mission.gates[0].X_WG.q) - 0.7);
    EXPECT_LE(std::abs(turn), 10.0 * M_PI / 180.0 + 1e-12);
  }
}

TEST(Knowledge, NoErrorsAskedForMeansTheTruth) {
  KnowledgeErrors none;
  none = {.extrinsics_angle = 0,
          .extrinsics_position = 0,
          .eye_angle = 0,
          .baseline = 0,
          .focal = 0,
          .time_offset = {},
          .start_position = 0,
          .start_yaw = 0,
          .gate_offset_min = 0,
          .gate_offset_max = 0,
          .gate_yaw = 0,
          .declination = 0};
  const stack::Calibration judged = Misjudge(Truth(), none, 3);
  EXPECT_LT((judged.cameras[1].X_BC.p - Truth().cameras[1].X_BC.p).norm(), 1e-15);
  const worlds::World world = testing::GroundAndCrate();
  EXPECT_EQ(SurveyMission(world, StartPose(world, 0.1), {}, none, 3).X_WB_start.p, base::Vec3(0, 0, 0.1));
}

}  // namespace
}  // namespace alula::sim
