#include "stack/estimation/sensor_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "base/error.h"
#include "tests/stack/estimation/wall.h"

namespace alula::stack::estimation::test {
namespace {

/// A body that stands before the wall and then swings sideways, up and in yaw, 0.8 m and 0.25 rad wide.
class Swing {
 public:
  Motion At(double t) const {
    const double s = t < kRest ? 0.0 : t - kRest;
    Motion m;
    m.X_WB.p = Vec3(0, 0.4 * Rise(s, 0.25), 0.15 * Rise(s, 0.5));
    const double yaw = 0.06 * Rise(s, 0.25) * kYaw;
    m.X_WB.q = base::FromYaw(yaw);
    return m;
  }
  /// What an IMU at `X_BI` reads, by differences.
  TimedImu Imu(Time time, const Transform& X_BI) const {
    constexpr double h = 2e-3;
    const double t = time.Seconds();
    const auto at = [&](double when) { return At(when).X_WB * X_BI; };
    const Transform before = at(t - h), now = at(t), after = at(t + h);
    const Vec3 a_W = (after.p - 2.0 * now.p + before.p) / (h * h);
    TimedImu sample;
    sample.time = time;
    sample.gyro = base::Log(before.q.conjugate() * after.q) / (2.0 * h);
    sample.accel = now.q.conjugate() * (a_W + Vec3(0, 0, base::kGravity));
    return sample;
  }
  static constexpr double kRest = 1.6;  // s

 private:
  static constexpr double kYaw = 2.0;
  /// 0 at rest, 2 at the far end of a swing; no jump in acceleration.
  static double Rise(double s, double rate) {
    const double blend = std::clamp(s, 0.0, 1.0);
    return blend * blend * blend * (10.0 - 15.0 * blend + 6.0 * blend * blend) *
           (1.0 - std::cos(2.0 * M_PI * rate * s));
  }
};

/// Where the wall's frame lies in the world: 3.5 m ahead of the first camera, its z away from it.
Transform WallPose(const Calibration& calibration) {
  Transform X_WV = calibration.cameras[0].X_BC;
  X_WV.p += Vec3(Wall::kDistance, 0, 0);
  return X_WV;
}

/// One grey level up or down, as any camera has it.
Image WithNoise(Image image, base::RandomStream& random) {
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(*image.bytes);
  for (std::size_t i = 0; i < bytes->size();) {
    for (std::uint64_t bits = random.Bits(), n = 0; n < 32 && i < bytes->size(); ++n, ++i, bits >>= 2U) {
      const int grey = (*bytes)[i] + ((bits & 3U) == 0 ? 1 : (bits & 3U) == 1 ? -1 : 0);
      (*bytes)[i] = static_cast<std::uint8_t>(std::clamp(grey, 0, 255));
    }
  }
  image.bytes = std::move(bytes);
  return image;
}

struct Setting {
  bool right = true, depth = false, imu = true;
  double seconds = 5.6;
  OdometryConfig config{};
  Calibration told = TrueCalibration();
  std::set<int> frozen{};  // frames that show the one before
  double eye_delay = 0.0;  // s
  double gyro_limit = 1e9;
  bool broken_samples = false;
};

struct Flown {
  std::vector<FrameResult> results;
  std::vector<Transform> truth;
  bool knows_vertical = false;
  std::set<std::string> notes;
  /// Largest error of position (m) from frame `from` on.
  double Worst(std::size_t from = 0) const {
    double worst = 0.0;
    for (std::size_t i = from; i < results.size(); ++i)
      if (results[i].initialised) worst = std::max(worst, (results[i].state.X_OB.p - truth[i].p).norm());
    return worst;
  }
};

Flown Fly(const Setting& s) {
  cv::setNumThreads(1);
  const Wall wall;
  const Swing swing;
  const Calibration truth = TrueCalibration();
  const Transform X_VW = WallPose(truth).Inverse();
  Odometry odometry(s.told, s.config, {});
  Flown flown;
  flown.knows_vertical = odometry.KnowsVertical();
  base::RandomStream random(3, "test/sensor_set");
  Time next_imu;
  FrameInput last;
  for (int i = 0; 0.05 * i < s.seconds; ++i) {
    FrameInput input;
    input.seq = static_cast<std::uint32_t>(i);
    input.stamp = Time{50'000'000LL * i};
    const double t = input.stamp.Seconds();
    const Transform X_VL = X_VW * swing.At(t).X_WB * truth.cameras[0].X_BC;
    const CameraIntrinsics& camera = truth.cameras[0].intrinsics;
    input.left = WithNoise(wall.Seen(camera, X_VL), random);
    if (s.right) input.right = wall.Seen(camera, X_VW * swing.At(t + s.eye_delay).X_WB * truth.cameras[1].X_BC);
    if (s.depth) input.depth = Wall::Depth(camera, X_VL);
    if (s.frozen.contains(i)) {
      input.left = last.left;
      input.right = last.right;
    }
    while (s.imu && next_imu <= input.stamp) {
      TimedImu sample = swing.Imu(next_imu, truth.imu->X_BI);
      sample.gyro += Vec3(0.002, -0.001, 0.003) + 2.4e-3 * random.GaussianVec3();
      sample.gyro = sample.gyro.cwiseMin(s.gyro_limit).cwiseMax(-s.gyro_limit);
      sample.accel += 0.028 * random.GaussianVec3();
      input.imu.push_back(sample);
      if (s.broken_samples && next_imu.ns % 95'000'000 == 0) {
        sample.accel.x() = std::nan("");
        sample.time += base::Milliseconds(1);
        input.imu.push_back(sample);
      }
      next_imu += base::Milliseconds(5);
    }
    last = input;
    flown.results.push_back(odometry.Process(input));
    flown.truth.push_back(swing.At(t).X_WB);
    flown.notes.insert(flown.results.back().note);
  }
  return flown;
}

Calibration WithoutImu() {
  Calibration calibration = TrueCalibration();
  calibration.imu.reset();
  return calibration;
}
/// The left camera and one that measures depth as it sees.
Calibration DepthCamera(bool imu) {
  Calibration calibration = imu ? TrueCalibration() : WithoutImu();
  calibration.stereo.reset();
  calibration.cameras[1] = calibration.cameras[0];
  calibration.cameras[1].kind = CameraKind::kDepth;
  return calibration;
}
Calibration OneCamera() {
  Calibration calibration = TrueCalibration();
  calibration.stereo.reset();
  calibration.cameras.pop_back();
  return calibration;
}

void BeginsAtOnceAndFollows(const Flown& flown, double metres) {
  EXPECT_FALSE(flown.knows_vertical);
  EXPECT_TRUE(flown.results.front().initialised);
  EXPECT_EQ(flown.results.back().reset_counter, 0U);
  EXPECT_LT(flown.Worst(), metres);
  EXPECT_GT(flown.results.back().inliers, 60);
}

TEST(SensorSets, APairNeedsNoImu) { BeginsAtOnceAndFollows(Fly({.imu = false, .told = WithoutImu()}), 0.03); }

TEST(SensorSets, ADepthCameraNeedsNoImu) {
  BeginsAtOnceAndFollows(Fly({.right = false, .depth = true, .imu = false, .told = DepthCamera(false)}), 0.03);
}

TEST(SensorSets, ADepthCameraWithAnImu) {
  const Flown flown = Fly({.right = false, .depth = true, .told = DepthCamera(true)});
  EXPECT_TRUE(flown.knows_vertical);
  EXPECT_TRUE(flown.results.back().initialised);
  EXPECT_LT(flown.Worst(), 0.03);
}

/// Scale comes from the accelerometer: 0.8 m of swing. Until it moves it stays where it is.
TEST(SensorSets, OneCameraWithAnImuKnowsTheScale) {
  const Flown flown = Fly({.right = false, .told = OneCamera()});
  const auto rest = static_cast<std::size_t>(Swing::kRest / 0.05);
  ASSERT_TRUE(flown.results[rest].initialised);
  EXPECT_LT(flown.results[rest].state.X_OB.p.norm(), 0.01);
  EXPECT_EQ(flown.results.back().reset_counter, 0U);
  EXPECT_LT(flown.Worst(), 0.08);
  EXPECT_LT(flown.Worst(flown.results.size() - 20), 0.05);
}

TEST(SensorSets, WhatIsAskedForWinsOverWhatThereIs) {
  SensorsConfig config;
  EXPECT_EQ(ChooseSensors(TrueCalibration(), config).rig.depth, features::DepthSource::kStereo);
  EXPECT_EQ(ChooseSensors(DepthCamera(true), config).rig.depth, features::DepthSource::kDepthCamera);
  EXPECT_EQ(ChooseSensors(OneCamera(), config).rig.depth, features::DepthSource::kNone);
  config.depth = DepthChoice::kNone;
  const SensorSet one = ChooseSensors(TrueCalibration(), config);
  EXPECT_EQ(one.rig.depth, features::DepthSource::kNone);
  EXPECT_FALSE(one.right);
  config.depth = DepthChoice::kAuto;
  config.imu = ImuChoice::kNone;
  EXPECT_FALSE(ChooseSensors(TrueCalibration(), config).imu);
}

std::string Refusal(const Calibration& calibration, const OdometryConfig& config) {
  try {
    Odometry(calibration, config, {});
  } catch (const base::InputError& e) {
    return e.what();
  }
  return "";
}

TEST(SensorSets, WhatIsNotEnoughIsRefusedWithTheReason) {
  OdometryConfig config;
  Calibration blind = TrueCalibration();
  blind.stereo.reset();
  blind.cameras.clear();
  EXPECT_NE(Refusal(blind, config).find("no camera"), std::string::npos);
  Calibration alone = OneCamera();
  alone.imu.reset();
  EXPECT_NE(Refusal(alone, config).find("one camera alone knows no scale"), std::string::npos);
  config.sensors.imu = ImuChoice::kUse;
  EXPECT_NE(Refusal(WithoutImu(), config).find("odometry.sensors.imu"), std::string::npos);
  config = {};
  config.sensors.depth = DepthChoice::kDepthCamera;
  EXPECT_NE(Refusal(TrueCalibration(), config).find("odometry.sensors.depth"), std::string::npos);
  config.sensors.depth = DepthChoice::kStereo;
  EXPECT_NE(Refusal(DepthCamera(true), config), "");
  config = {};
  config.lines.enabled = true;
  EXPECT_NE(Refusal(DepthCamera(true), config).find("odometry.lines.enabled"), std::string::npos);
}

// --- what comes in is watched --------------------------------------------------------------------------------------

TEST(InputGuards, AHealthySwingHasNothingToSay) {
  const Flown flown = Fly({});
  for (const std::string& note : flown.notes)
    EXPECT_TRUE(note.empty() || note == "waiting for standstill" || note == "standing still, averaging") << note;
  EXPECT_LT(flown.Worst(), 0.02);
}

TEST(InputGuards, FrozenImagesAreNotStandstill) {
  std::set<int> frozen;
  for (int i = 60; i < 80; ++i) frozen.insert(i);
  const Flown flown = Fly({.frozen = frozen});
  EXPECT_TRUE(flown.notes.contains("the images are frozen"));
  EXPECT_EQ(flown.results.back().reset_counter, 0U);
  EXPECT_LT(flown.Worst(90), 0.06);
}

TEST(InputGuards, ASaturatedGyroscopeIsSaidAndBridged) {
  Calibration told = TrueCalibration();
  told.imu->noise.gyro_range = 0.12;
  const Flown flown = Fly({.told = told, .gyro_limit = 0.12});
  EXPECT_TRUE(flown.notes.contains("the gyroscope is saturated"));
  EXPECT_EQ(flown.results.back().reset_counter, 0U);
  EXPECT_LT(flown.Worst(), 0.05);
}

TEST(InputGuards, SamplesThatAreNoNumbersAreLeftOut) {
  const Flown flown = Fly({.broken_samples = true});
  EXPECT_TRUE(flown.notes.contains("inertial samples that are no numbers were left out"));
  EXPECT_LT(flown.Worst(), 0.02);
}

/// 20 ms: said, and moved back.
TEST(InputGuards, EyesThatSeeAtDifferentTimesAreFoundOut) {
  Setting setting{.seconds = 9.6, .eye_delay = 0.02};
  const Flown flown = Fly(setting);
  EXPECT_TRUE(flown.notes.contains("the right eye sees about 20 ms later than the left one"));
  setting.config.guard.compensate_eye_delay = false;
  const Flown uncompensated = Fly(setting);
  const std::size_t late = flown.results.size() - 60;
  EXPECT_LT(flown.Worst(late), 0.7 * uncompensated.Worst(late));
}

/// A camera that is mounted upside down against what the calibration says.
TEST(InputGuards, AWrongSignOfTheExtrinsicsIsSaid) {
  Calibration told = TrueCalibration();
  for (CameraCalibration& camera : told.cameras)
    camera.X_BC = camera.X_BC * Transform{base::Exp(Vec3(0, 0, M_PI)), {0, 0, 0}};
  // The pair keeps its geometry: the eye that was left is right.
  const Transform X_LR = TrueCalibration().cameras[0].X_BC.Inverse() * TrueCalibration().cameras[1].X_BC;
  told.cameras[1].X_BC = told.cameras[0].X_BC * X_LR;
  const Flown flown = Fly({.seconds = 7.6, .told = told});
  bool said = false;
  for (const std::string& note : flown.notes)
    said = said || note.find("is the camera's pose on the body right?") != std::string::npos;
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace alula::stack::estimation::test
