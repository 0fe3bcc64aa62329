// The checks of cameras: what is as configured passes, what is not is found out. Small pictures, few frames.
#include <gtest/gtest.h>

#include <cstdlib>

#include "scenarios/check/depth_check.h"
#include "scenarios/check/exposure_check.h"
#include "scenarios/check/frame_faults_check.h"
#include "scenarios/check/lens_check.h"
#include "scenarios/check/photon_transfer_check.h"
#include "scenarios/check/shutter_check.h"
#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;
using Kind = CameraGroup::Kind;

/// Mesa reads these when its first context is made.
const bool kEnvironment = [] {
  ::setenv("LP_NUM_THREADS", "0", 1);
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  return true;
}();

constexpr CameraGroup kPair{Kind::kStereo, 0}, kSingle{Kind::kCamera, 0}, kRgbd{Kind::kRgbd, 0};

Rig RigWith(const sim::StereoCameraConfig& stereo) {
  Rig rig = testing::EmptyRig();
  rig.sensors.stereo = stereo;
  return rig;
}
Rig RigWith(const sim::NamedCameraConfig& camera) {
  Rig rig = testing::EmptyRig();
  rig.sensors.cameras = {camera};
  return rig;
}

template <typename Camera>
Camera Small() {
  Camera camera;
  camera.width = 320;
  camera.height = 240;
  return camera;
}
sim::NamedCameraConfig SmallCamera() {
  auto camera = Small<sim::NamedCameraConfig>();
  camera.name = "front";
  return camera;
}

Report LensReport(const sim::SensorsConfig& built, const sim::SensorsConfig& claimed, const CameraGroup& group) {
  Rig rig = testing::EmptyRig(), said = rig;
  rig.sensors = built;
  said.sensors = claimed;
  Report report;
  CheckLens(Isolate(rig, group), group, GeometryOf(Isolate(said, group), group), report);
  return report;
}

TEST(LensCheck, PairsBaselineAndMount) {
  const auto claimed = Small<sim::StereoCameraConfig>();
  const Report right = LensReport(RigWith(claimed).sensors, RigWith(claimed).sensors, kPair);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::StereoCameraConfig built = claimed;
  built.baseline *= 1.01;
  built.pitch += 0.02;
  const Report wrong = LensReport(RigWith(built).sensors, RigWith(claimed).sensors, kPair);
  EXPECT_EQ(Failed(wrong), (Names{"baseline", "mount's angle to the configured one"})) << ToTable(wrong);
}

TEST(LensCheck, RadialTangentialCoefficients) {
  sim::NamedCameraConfig claimed = SmallCamera();
  claimed.lens.coefficients = {-0.28, 0.07, 0.0008, -0.0005};
  const Report right = LensReport(RigWith(claimed).sensors, RigWith(claimed).sensors, kSingle);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::NamedCameraConfig built = claimed;
  built.lens.coefficients[0] *= 1.05;
  const Report wrong = LensReport(RigWith(built).sensors, RigWith(claimed).sensors, kSingle);
  EXPECT_TRUE(Failed(wrong).contains("k1")) << ToTable(wrong);
  EXPECT_TRUE(Failed(wrong).contains("lens model's difference, largest"));
}

TEST(LensCheck, EquidistantCoefficients) {
  sim::NamedCameraConfig claimed = SmallCamera();
  claimed.fov = 2.6;
  claimed.lens = {stack::DistortionModel::kEquidistant, {-0.02, 0.005, -0.001, 0.0}};
  const Report right = LensReport(RigWith(claimed).sensors, RigWith(claimed).sensors, kSingle);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::NamedCameraConfig built = claimed;
  built.lens.coefficients[0] = -0.04;
  const Report wrong = LensReport(RigWith(built).sensors, RigWith(claimed).sensors, kSingle);
  EXPECT_TRUE(Failed(wrong).contains("lens model's difference, largest")) << ToTable(wrong);
}

TEST(PhotonTransferCheck, FivePercent) {
  for (const stack::CameraKind kind : {stack::CameraKind::kGrey, stack::CameraKind::kColour}) {
    sim::NamedCameraConfig claimed = SmallCamera();
    claimed.kind = kind;
    const auto measure = [&](const sim::NamedCameraConfig& built) {
      const Rig rig = Isolate(RigWith(built), kSingle);
      Report report;
      CheckPhotonTransfer(rig, claimed, GeometryOf(rig, kSingle), report);
      return report;
    };
    const Report right = measure(claimed);
    EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
    sim::NamedCameraConfig built = claimed;
    built.noise.read_sigma *= 1.1;
    built.noise.shot *= 0.9;
    EXPECT_EQ(Failed(measure(built)).size(), 2U) << ToTable(measure(built));
  }
}

Report ShutterReport(const sim::StereoCameraConfig& built, const sim::StereoCameraConfig& claimed) {
  const Rig rig = Isolate(RigWith(built), kPair);
  const sim::SensorsConfig said = RigWith(claimed).sensors;
  Report report;
  const std::vector<CameraGeometry> cameras = GeometryOf(rig, kPair);
  CheckShutter(rig, kPair, said, cameras, report);
  // With both 64 × 64 pictures would be drawn.
  if (claimed.row_delay.ns == 0) CheckSubFrames(rig, kPair, claimed, cameras.front(), report);
  return report;
}

TEST(ShutterCheck, BlurRollingAndStamps) {
  auto claimed = Small<sim::StereoCameraConfig>();
  claimed.motion_blur = true;
  claimed.row_delay = base::Microseconds(40);
  claimed.eye_offset = base::Milliseconds(2);
  claimed.eye_offset_every = 3;
  claimed.read_out = base::Milliseconds(20);
  const Report right = ShutterReport(claimed, claimed);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::StereoCameraConfig built = claimed;
  built.row_delay = base::Microseconds(44);
  built.exposure = base::Microseconds(4400);
  built.eye_offset = base::Milliseconds(3);
  const Report wrong = ShutterReport(built, claimed);
  const Names failed = Failed(wrong);
  EXPECT_TRUE(failed.contains("exposure, from the blur of an edge")) << ToTable(wrong);
  EXPECT_TRUE(failed.contains("row delay, from the slant of an edge"));
  EXPECT_TRUE(failed.contains("stamps' offset, every 3 frames"));
  EXPECT_FALSE(failed.contains("stamps' offset, other frames"));
}

TEST(ShutterCheck, BlurThatIsNotThereIsFoundOut) {
  auto claimed = Small<sim::StereoCameraConfig>();
  claimed.motion_blur = true;
  sim::StereoCameraConfig built = claimed;
  built.motion_blur = false;
  const Report wrong = ShutterReport(built, claimed);
  EXPECT_EQ(Failed(wrong), (Names{"exposure, from the blur of an edge", "mean difference to 64 sub-frames"}))
      << ToTable(wrong);
}

TEST(FrameFaultsCheck, LostLateFrozen) {
  sim::NamedCameraConfig claimed = SmallCamera();
  claimed.faults = {.drop = 0.1, .late = 0.2, .late_by = base::Milliseconds(40), .freeze = 0.1, .freeze_frames = 3};
  const auto measure = [&](const sim::NamedCameraConfig& built) {
    Report report;
    CheckFrameFaults(RigWith(built), kSingle, claimed, report);
    return report;
  };
  const Report right = measure(claimed);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::NamedCameraConfig built = claimed;
  built.rate = {21, 1};
  built.read_out = base::Milliseconds(11);
  built.faults = {.drop = 0.2, .late = 0.4, .late_by = base::Milliseconds(60), .freeze = 0.2, .freeze_frames = 4};
  const Report wrong = measure(built);
  EXPECT_EQ(Failed(wrong),
            (Names{"rate", "read-out", "share of frames lost", "share of frames late", "lateness, twice its mean",
                   "share of frames at which it freezes", "frames that it stays frozen"}))
      << ToTable(wrong);
}

TEST(ExposureCheck, TargetDelayAndSpeed) {
  sim::NamedCameraConfig claimed = SmallCamera();
  claimed.auto_exposure.emplace();
  const auto measure = [&](const sim::NamedCameraConfig& built) {
    Report report;
    CheckExposureControl(RigWith(built), kSingle, claimed, report);
    return report;
  };
  const Report right = measure(claimed);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::NamedCameraConfig built = claimed;
  built.auto_exposure->target *= 1.05;
  built.auto_exposure->delay = 3;
  const Report wrong = measure(built);
  EXPECT_TRUE(Failed(wrong).contains("exposure control: mean it settles at, dark")) << ToTable(wrong);
  EXPECT_TRUE(Failed(wrong).contains("exposure control: frames until it obeys"));
  built = claimed;
  built.auto_exposure->speed = 0.4;
  EXPECT_EQ(Failed(measure(built)), Names{"exposure control: speed"}) << ToTable(measure(built));
}

sim::RgbdCameraConfig SmallRgbd() {
  sim::RgbdCameraConfig camera;
  camera.name = "rgbd";
  camera.width = camera.depth.width = 320;
  camera.height = camera.depth.height = 240;
  return camera;
}

Report DepthReport(const sim::RgbdCameraConfig& built, const sim::RgbdCameraConfig& claimed) {
  Rig rig = testing::EmptyRig();
  rig.sensors.rgbd = {built};
  Report report;
  CheckDepth(Isolate(rig, kRgbd), kRgbd, claimed, report);
  return report;
}

TEST(DepthCheck, RangeLimitsShadowsAndRegistration) {
  sim::RgbdCameraConfig claimed = SmallRgbd();
  claimed.depth.light.blinding = 0.8;
  const Report right = DepthReport(claimed, claimed);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);

  sim::RgbdCameraConfig built = claimed;
  built.depth.light.disparity_noise *= 1.3;
  built.depth.light.nearest *= 1.05;
  built.depth.light.holes = 0.01;
  built.depth.light.grazing -= 0.03;
  built.depth.light.blinding = 0.9;
  built.depth.read_out = base::Milliseconds(31);
  const Report wrong = DepthReport(built, claimed);
  for (const char* name : {"spread at 2700 mm", "nearest", "share lost at 2700 mm", "grazing angle",
                           "share lost in light above the limit", "read-out"}) {
    EXPECT_TRUE(Failed(wrong).contains(name)) << name << '\n' << ToTable(wrong);
  }
  EXPECT_FALSE(Failed(wrong).contains("farthest"));

  built = claimed;
  built.depth.light.baseline *= 1.3;
  built.depth.offset += 0.03;
  const Report moved = DepthReport(built, claimed);
  EXPECT_TRUE(Failed(moved).contains("shadow beside an edge")) << ToTable(moved);
}

}  // namespace
}  // namespace alula::scenarios::check
