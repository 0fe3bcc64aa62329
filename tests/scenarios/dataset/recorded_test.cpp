// Recordings of others through our readers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/layouts.h"
#include "stack/features/depth_registration.h"
#include "stack/interface/grey.h"

namespace alula::scenarios::dataset {
namespace {

std::optional<std::filesystem::path> DataFolder(const std::string& name) {
  const char* root = std::getenv("ALULA_DATA");
  if (root == nullptr || *root == '\0') return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(root) / name;
  if (!std::filesystem::exists(folder)) return std::nullopt;
  return folder;
}

TEST(RecordedEuroc, ReadsASequenceOfTheVicon) {
  const auto folder = DataFolder("euroc_v101_standstill");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no euroc_v101_standstill";
  const Recording recording = OpenRecording(*folder);
  EXPECT_EQ(recording.layout, Layout::kEuroc);
  ASSERT_EQ(recording.calibration.cameras.size(), 2u);
  EXPECT_EQ(recording.images[0].size(), 95u);
  EXPECT_EQ(recording.images[1].size(), 95u);
  EXPECT_GE(recording.missing_images, 4);  // stamps of cam1 without an image
  EXPECT_EQ(recording.imu.size(), 29'120u);
  EXPECT_GT(recording.truth.size(), 2000u);
  EXPECT_EQ(recording.imu.front().time.ns, 1403715273262142976);
  EXPECT_EQ(recording.calibration.imu->noise.gyro_noise, 1.6968e-4);
  EXPECT_EQ(recording.calibration.imu->noise.accelerometer_bias_walk, 3.0e-3);
  EXPECT_EQ(recording.calibration.cameras[0].intrinsics.fx, 458.654);
  EXPECT_EQ(recording.calibration.cameras[1].intrinsics.distortion[0], -0.28368365);
  EXPECT_EQ(recording.calibration.cameras[0].rate, (base::Rate{20, 1}));
  // The eyes are 11 cm apart.
  const double baseline = (recording.calibration.cameras[0].X_BC.p - recording.calibration.cameras[1].X_BC.p).norm();
  EXPECT_NEAR(baseline, 0.110, 0.001);
  const stack::Image image = LoadImage(recording.images[0][10], recording.calibration.cameras[0]);
  EXPECT_EQ(image.width, 752);
  EXPECT_EQ(image.height, 480);
  // At rest the accelerometer, less its bias, reads gravity along the world's z.
  const BodyTruth& first = recording.truth.front();
  base::Vec3 mean = base::Vec3::Zero();
  for (std::size_t i = 0; i < 200; ++i) mean += recording.imu[i].sample.specific_force / 200;
  EXPECT_LT((first.X_WB.q * (mean - first.accelerometer_bias) - base::Vec3(0, 0, 9.81)).norm(), 0.1);
}

double PathLength(const std::vector<BodyTruth>& truth) {
  double path = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) path += (truth[i].X_WB.p - truth[i - 1].X_WB.p).norm();
  return path;
}

TEST(RecordedKitti, ReadsADrive) {
  const auto folder = DataFolder("kitti_stereo");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no kitti_stereo";
  const Recording recording = OpenRecording(*folder);
  EXPECT_EQ(recording.layout, Layout::kKitti);
  const auto& cameras = recording.calibration.cameras;
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(recording.calibration.stereo, (std::array{0, 1}));
  EXPECT_EQ(cameras[0].intrinsics.fx, 707.0912);
  EXPECT_EQ(cameras[0].rate, (base::Rate{10, 1}));
  EXPECT_NEAR((cameras[1].X_BC.p - cameras[0].X_BC.p).y(), -0.537, 0.001);
  EXPECT_EQ(recording.missing_images, 0);
  for (std::size_t c = 0; c < 2; ++c) {
    ASSERT_EQ(recording.images[c].size(), 51u);
    for (const ImageFile& file : recording.images[c]) {
      const stack::Image image = LoadImage(file, cameras[c]);
      EXPECT_EQ(image.width, 1226);
      EXPECT_EQ(image.height, 370);
    }
  }
  ASSERT_EQ(recording.truth.size(), 51u);
  EXPECT_NEAR(PathLength(recording.truth), 59.9, 0.05);
  // It drives forward on a road: nearly all of the way is along x, hardly any of it up.
  const base::Transform& last = recording.truth.back().X_WB;
  EXPECT_GT(last.p.x(), 55);
  EXPECT_LT(std::abs(last.p.z()), 3);
  EXPECT_LT((last.q * base::Vec3(0, 0, 1) - base::Vec3(0, 0, 1)).norm(), 0.1);
}

TEST(RecordedTum, ReadsARoom) {
  const auto folder = DataFolder("rgbd_room");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no rgbd_room";
  const Recording recording = OpenRecording(*folder);
  EXPECT_EQ(recording.layout, Layout::kTum);
  const auto& cameras = recording.calibration.cameras;
  ASSERT_TRUE(recording.depth);
  EXPECT_EQ(recording.depth->values_per_metre, 1000);
  EXPECT_EQ(cameras[0].rate, (base::Rate{30, 1}));
  EXPECT_EQ(recording.missing_images, 0);
  ASSERT_EQ(recording.images[0].size(), 280u);
  ASSERT_EQ(recording.images[1].size(), 280u);
  EXPECT_EQ(recording.truth.size(), 280u);
  EXPECT_NEAR(PathLength(recording.truth), 6.87, 0.01);  // as the file's positions add up to
  // The world is levelled: somebody holds the camera upright, 15 to 36 degrees down.
  for (const BodyTruth& truth : recording.truth) {
    EXPECT_GT((truth.X_WB.q * base::Vec3::UnitZ()).z(), 0.8);
    EXPECT_LT((truth.X_WB.q * base::Vec3::UnitX()).z(), -0.2);
  }
  for (std::size_t k = 0; k < 280; ++k) {
    EXPECT_EQ(recording.depth->of_picture[k], k);
    const stack::Image image = LoadImage(recording.images[0][k], cameras[0]);
    EXPECT_EQ(image.format, stack::PixelFormat::kRgb8);
    EXPECT_EQ(stack::ToGrey(image).bytes->size(), 640u * 480u);
    // A Kinect sees 0.4 to 8 m; here a desk at 1 to 3 m, and most of the picture.
    std::vector<std::uint16_t> mm = *LoadDepth(recording.images[1][k], cameras[1], 1000).millimetres;
    mm.erase(std::remove(mm.begin(), mm.end(), std::uint16_t{0}), mm.end());
    ASSERT_GT(mm.size(), 640u * 480u / 2) << k;
    std::sort(mm.begin(), mm.end());
    EXPECT_GT(mm[mm.size() / 100], 300) << k;
    EXPECT_LT(mm[mm.size() / 2], 4000) << k;
    EXPECT_LT(mm.back(), 12'000) << k;
  }
}

/// The nearest depth in the row or column from (u, v) on, at most 8 px away; 0 where there is none.
int NextDepth(const stack::DepthImage& depth, int u, int v, int du, int dv) {
  for (int k = 1; k <= 8; ++k) {
    const int mm = (*depth.millimetres)[static_cast<std::size_t>((v + k * dv) * depth.width + u + k * du)];
    if (mm != 0) return mm;
  }
  return 0;
}

/// Mean gradient of the picture (grey levels over two pixels, at most 60) where depth that was drawn into it has the
/// rim of something near: a rim in the right place is mostly an edge of the picture.
double GradientAtRims(const Recording& recording) {
  constexpr int kBorder = 12;
  const auto& cameras = recording.calibration.cameras;
  const stack::features::DepthRegistration into_picture(cameras[1], cameras[0]);
  double sum = 0;
  int rims = 0;
  for (std::size_t k = 0; k < recording.images[0].size(); k += 28) {
    const stack::Image grey = stack::ToGrey(LoadImage(recording.images[0][k], cameras[0]));
    const stack::DepthImage depth =
        into_picture(LoadDepth(recording.images[1][k], cameras[1], recording.depth->values_per_metre));
    for (int v = kBorder; v < grey.height - kBorder; ++v) {
      for (int u = kBorder; u < grey.width - kBorder; ++u) {
        const int mm = (*depth.millimetres)[static_cast<std::size_t>(v * depth.width + u)];
        int behind = 0;
        for (const auto& [du, dv] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
          behind = std::max(behind, NextDepth(depth, u, v, du, dv));
        }
        if (mm == 0 || behind < 1.15 * mm) continue;
        const double x = grey.Row(v)[u + 1] - grey.Row(v)[u - 1], y = grey.Row(v + 1)[u] - grey.Row(v - 1)[u];
        sum += std::min(60.0, std::hypot(x, y));
        ++rims;
      }
    }
  }
  return sum / rims;
}

TEST(RecordedTum, DepthIsDrawnOntoThePicture) {
  const auto folder = DataFolder("rgbd_room");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no rgbd_room";
  const double nominal = GradientAtRims(OpenRecording(*folder));
  Recording fitted = OpenRecording(*folder, "docs/examples/recordings/seven_scenes_camera.yaml");
  ASSERT_FALSE(stack::features::Registered(fitted.calibration.cameras[0], fitted.calibration.cameras[1]));
  const double right = GradientAtRims(fitted);
  std::printf("gradient at rims of depth: %.1f with camera.yaml, %.1f with the fitted calibration\n", nominal, right);
  EXPECT_GT(right, 1.5 * nominal);
  // The place of the depth camera is seen: 15 mm to either side (5 px at 1.5 m), and the wrong way round.
  base::Transform& X_BD = fitted.calibration.cameras[1].X_BC;
  const base::Transform as_fitted = X_BD;
  for (const double left : {0.015, -0.015, -0.050}) {
    X_BD.p = as_fitted.p + base::Vec3(0, left, 0);
    EXPECT_LT(GradientAtRims(fitted), 0.9 * right) << left;
  }
}

}  // namespace
}  // namespace alula::scenarios::dataset
