// The parts that a camera is made of, one by one: gimbal, exposure control, faults of frames, cutting of exposures.
#include <gtest/gtest.h>

#include <cmath>

#include "base/config.h"
#include "base/error.h"
#include "sim/sensors/auto_exposure.h"
#include "sim/sensors/camera_suite.h"
#include "sim/sensors/exposure.h"
#include "sim/sensors/frame_faults.h"
#include "sim/sensors/gimbal.h"
#include "sim/sensors/suite.h"
#include "stack/interface/camera_model.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

using base::Vec3;

constexpr base::Duration kStep = base::Milliseconds(1);

vehicles::BodyState Tilted(double roll, double pitch, double yaw) {
  vehicles::BodyState state = testing::At({0, 0, 1});
  state.X_WB.q = base::FromYawPitchRoll(yaw, pitch, roll);
  return state;
}

GimbalConfig Plain() {
  GimbalConfig config;
  config.name = "nose";
  config.levelling_error = 0;
  config.encoder_noise = 0;
  return config;
}

double PitchAt(const Gimbal& gimbal, base::Time t) { return std::asin(-(gimbal.At(t).q * Vec3::UnitX()).z()); }

TEST(Gimbal, AnswersAStepAsAFirstOrderLagWithALimitOfSpeed) {
  GimbalConfig config = Plain();
  config.lag = base::Milliseconds(100);
  config.fastest = 2.0;
  Gimbal gimbal(config, 1, "g");
  const vehicles::BodyState still = testing::At({0, 0, 1});
  gimbal.Settle({0}, still);
  gimbal.Want({.gimbal = 0, .roll = 0, .pitch = 0.5, .yaw = 0});
  // At 2 rad/s until the error is lag · fastest = 0.2 rad: 0.15 s; then 0.2 e^(−t/lag).
  base::Time t;
  for (int i = 0; i < 350; ++i) gimbal.Step(t += kStep, still, kStep);
  EXPECT_NEAR(PitchAt(gimbal, {100'000'000}), 0.2, 1e-9);
  EXPECT_NEAR(PitchAt(gimbal, t), 0.5 - 0.2 * std::exp(-2.0), 2e-3);  // the corner between the two lies inside a step
}

TEST(Gimbal, StopsAtItsStops) {
  GimbalConfig config = Plain();
  config.high.y() = 0.3;
  Gimbal gimbal(config, 1, "g");
  gimbal.Settle({0}, testing::At({0, 0, 1}));
  gimbal.Want({.gimbal = 0, .roll = 0, .pitch = 1.0, .yaw = 0});
  base::Time t;
  for (int i = 0; i < 2000; ++i) gimbal.Step(t += kStep, testing::At({0, 0, 1}), kStep);
  EXPECT_NEAR(PitchAt(gimbal, t), 0.3, 1e-9);
  EXPECT_NEAR(gimbal.Sample().pitch, 0.3, 1e-9);
}

TEST(Gimbal, HoldsTheHorizonUnderATiltingBody) {
  GimbalConfig config = Plain();
  config.stabilised = true;
  config.start = {0, 0.4, 0};
  Gimbal gimbal(config, 1, "g");
  const vehicles::BodyState state = Tilted(0.2, -0.15, 1.1);
  gimbal.Settle({0}, state);
  const base::Quat q_WG = state.X_WB.q * gimbal.At({0}).q;
  const double heading = base::Yaw(state.X_WB.q);
  EXPECT_LT(base::Log(q_WG.conjugate() * base::FromYawPitchRoll(heading, 0.4, 0)).norm(), 1e-9);
}

TEST(Gimbal, LevelsWithTheErrorItIsGiven) {
  GimbalConfig config = Plain();
  config.stabilised = true;
  config.levelling_error = 0.01;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Gimbal gimbal(config, seed, "g");
    gimbal.Settle({0}, Tilted(0, 0, 0));
    squares += base::Log(gimbal.At({0}).q).squaredNorm();
  }
  // Two axes; the sum over 200 draws of χ²(2) lies within 4 σ = 20 % of its mean.
  EXPECT_NEAR(std::sqrt(squares / 400), 0.01, 0.1 * 0.01);
}

CameraConfig Metered() {
  CameraConfig config;
  config.auto_exposure = AutoExposureConfig{};
  return config;
}

/// Runs the control against a scene whose mean at the nominal exposure is `scene` (share of full scale).
double Settled(ExposureControl& control, const CameraConfig& config, double scene, int frames) {
  double mean = 0;
  for (int i = 0; i < frames; ++i) {
    const ExposureSetting setting = control.Current();
    mean = std::min(1.0, scene * setting.length.Seconds() * setting.gain / config.exposure.Seconds());
    control.See(mean, setting);
  }
  return mean;
}

TEST(AutoExposure, BringsTheMeanToItsTarget) {
  const CameraConfig config = Metered();
  for (const double scene : {0.1, 0.3, 0.7, 2.0}) {
    ExposureControl control(config);
    EXPECT_NEAR(Settled(control, config, scene, 40), config.auto_exposure->target, 0.01) << scene;
  }
}

TEST(AutoExposure, LengthensTheExposureBeforeItTurnsUpTheGain) {
  const CameraConfig config = Metered();
  ExposureControl control(config);
  Settled(control, config, 0.05, 60);
  EXPECT_EQ(control.Current().length, config.auto_exposure->longest);
  EXPECT_NEAR(control.Current().gain, 0.42 / 0.05 / 2, 0.05);  // longest is twice the nominal exposure
  Settled(control, config, 1e-3, 60);
  EXPECT_EQ(control.Current().gain, config.auto_exposure->largest_gain);
}

TEST(AutoExposure, ObeysAfterItsDelay) {
  CameraConfig config = Metered();
  config.auto_exposure->delay = 3;
  ExposureControl control(config);
  for (int i = 0; i < 2; ++i) {
    control.See(0.1, control.Current());
    EXPECT_EQ(control.Current().length, config.exposure);
  }
  control.See(0.1, control.Current());
  EXPECT_GT(control.Current().length, config.exposure);
}

TEST(FrameFaults, StrikeAsOftenAsStated) {
  FrameFaultsConfig config;
  config.drop = 0.1;
  config.late = 0.2;
  config.freeze = 0.01;
  config.freeze_frames = 4;
  FrameFaults faults(config, 3, "camera");
  int dropped = 0, late = 0, frozen = 0;
  base::Duration latest{};
  constexpr int kFrames = 20000;
  for (int i = 0; i < kFrames; ++i) {
    const FrameFate fate = faults.Next();
    dropped += fate.dropped;
    late += fate.late_by.ns > 0;
    frozen += fate.frozen;
    latest = std::max(latest, fate.late_by);
  }
  EXPECT_NEAR(dropped, 2000, 4 * std::sqrt(1800));
  EXPECT_NEAR(late, 4000, 4 * std::sqrt(3200));
  EXPECT_NEAR(frozen, kFrames * 0.04 / 1.03, 4 * 4 * std::sqrt(200));  // four frames each, and none begins in one
  EXPECT_LE(latest, config.late_by);
  EXPECT_GT(latest.ns, config.late_by.ns * 9 / 10);
}

TEST(Exposure, IsOneInstantWhereNothingMovesOrNothingIsIntegrated) {
  CameraConfig config;
  const auto at = [](base::Time t) { return Instant{{base::FromYaw(3.0 * t.Seconds()), Vec3::Zero()}, {}}; };
  const Exposure sharp = PlanExposure(config, 400, {base::Milliseconds(4), 1.0}, {100'000'000}, at);
  ASSERT_EQ(sharp.slices.size(), 1U);
  ASSERT_EQ(sharp.slices[0].instants.size(), 1U);
  EXPECT_NEAR(base::Yaw(sharp.slices[0].instants[0].X_WC.q), 0.3, 1e-12);
  config.motion_blur = true;
  const auto still = [](base::Time) { return Instant{}; };
  EXPECT_EQ(PlanExposure(config, 400, {base::Milliseconds(4), 1.0}, {0}, still).slices[0].instants.size(), 1U);
}

TEST(Exposure, SpreadsItsInstantsEvenlyOverItsLength) {
  CameraConfig config;
  config.motion_blur = true;
  const auto at = [](base::Time t) { return Instant{{base::FromYaw(3.0 * t.Seconds()), Vec3::Zero()}, {}}; };
  // 3 rad/s · 4 ms · 400 px = 4.8 px; one instant a 0.75 px.
  const Exposure blurred = PlanExposure(config, 400, {base::Milliseconds(4), 1.0}, {100'000'000}, at);
  ASSERT_EQ(blurred.slices.size(), 1U);
  const auto& instants = blurred.slices[0].instants;
  ASSERT_EQ(instants.size(), 7U);
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(base::Yaw(instants[static_cast<std::size_t>(i)].X_WC.q), 3.0 * (0.1 + 4e-3 * ((i + 0.5) / 7 - 0.5)),
                1e-8);
  }
}

TEST(Exposure, RollsFromTheFirstRowToTheLast) {
  CameraConfig config;
  config.row_delay = base::Microseconds(30);
  const auto at = [](base::Time t) { return Instant{{base::FromYaw(3.0 * t.Seconds()), Vec3::Zero()}, {}}; };
  const Exposure rolled = PlanExposure(config, 400, {base::Milliseconds(4), 1.0}, {100'000'000}, at);
  ASSERT_GT(rolled.slices.size(), 10U);
  int row = 0;
  for (const Exposure::Slice& slice : rolled.slices) {
    EXPECT_EQ(slice.first_row, row);
    row += slice.rows;
    const double middle = slice.first_row + 0.5 * (slice.rows - 1) - 0.5 * (config.height - 1);
    EXPECT_NEAR(base::Yaw(slice.instants[0].X_WC.q), 3.0 * (0.1 + 30e-6 * middle), 1e-7);
  }
  EXPECT_EQ(row, config.height);
}

/// What YAML says of a stereo camera; throws what a person would read.
SensorsConfig ReadSensors(const std::string& stereo) {
  const auto document = base::YamlDocument::Parse("stereo: {" + stereo + "}\n", "sensors.yaml", {}, {});
  return base::ReadConfig<SensorsConfig>(document, 1);
}

std::string Complaint(const std::string& stereo) {
  try {
    ReadSensors(stereo);
  } catch (const base::InputError& e) {
    return e.what();
  }
  return {};
}

TEST(CameraConfig, RefusesWhatNoCameraCanBe) {
  EXPECT_EQ(Complaint("fov: 80 deg"), "");
  EXPECT_NE(Complaint("fov: 175 deg").find("fov"), std::string::npos);
  EXPECT_NE(Complaint("fov: 175 deg").find("equidistant"), std::string::npos);
  EXPECT_EQ(Complaint("fov: 175 deg, lens: {model: equidistant}"), "");
  EXPECT_NE(Complaint("fov: 100 deg, lens: {coefficients: [-0.6]}").find("fold"), std::string::npos);
  EXPECT_NE(Complaint("lens: {model: equidistant, coefficients: [0, 0, 0, 0, 0]}").find("coefficients"),
            std::string::npos);
  EXPECT_NE(Complaint("width: 0").find("width"), std::string::npos);
  EXPECT_NE(Complaint("exposure: 30 ms").find("read_out"), std::string::npos);
  EXPECT_NE(Complaint("row_delay: 200 us, read_out: 60 ms").find("frame"), std::string::npos);
  EXPECT_NE(Complaint("auto_exposure: {longest: 50 us}").find("longest"), std::string::npos);
  EXPECT_NE(Complaint("eye_offset: 9 ms").find("read_out"), std::string::npos);
}

TEST(CameraConfig, FieldOfViewIsWhatTheBentLensSees) {
  for (const char* lens : {"", ", lens: {coefficients: [-0.2, 0.03]}", ", lens: {model: equidistant}",
                           ", lens: {model: equidistant, coefficients: [0.02, -0.01]}"}) {
    const stack::CameraIntrinsics k = IntrinsicsOf(*ReadSensors(std::string("fov: 90 deg") + lens).stereo);
    const double edge = k.cx + 0.5 * k.width;
    const double u = stack::Project(k, Vec3(1, 0, 1)).x();
    EXPECT_NEAR(u, edge, 1e-9) << lens;
  }
}

TEST(CameraConfig, NamesAreUniqueAndGimbalsExist) {
  SensorsConfig sensors;
  sensors.cameras.resize(2);
  sensors.cameras[0].name = sensors.cameras[1].name = "down";
  EXPECT_THROW(TrueCalibration(sensors, testing::PlateOnLegs(), "vehicle0"), base::InputError);
  sensors.cameras[1].name = "up";
  sensors.cameras[1].gimbal = "nose";
  EXPECT_THROW(TrueCalibration(sensors, testing::PlateOnLegs(), "vehicle0"), base::InputError);
  sensors.gimbals.push_back(Plain());
  const stack::Calibration calibration = TrueCalibration(sensors, testing::PlateOnLegs(), "vehicle0");
  ASSERT_EQ(calibration.cameras.size(), 2U);
  EXPECT_EQ(calibration.cameras[0].name, "vehicle0/camera.down");
  EXPECT_FALSE(calibration.cameras[0].gimbal);
  EXPECT_EQ(calibration.cameras[1].gimbal, 0);
}

}  // namespace
}  // namespace alula::sim
