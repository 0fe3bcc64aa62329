// Recordings of others through our readers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/layouts.h"

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
  // Somebody holds the camera 1 to 2 m above the floor and looks at a desk: 25 m in 33 s, hardly any of it upward.
  EXPECT_LT(PathLength(recording.truth), 60);
  for (std::size_t k = 0; k < 280; ++k) {
    EXPECT_EQ(recording.depth->of_picture[k], k);
    const stack::Image image = LoadImage(recording.images[0][k], cameras[0]);
    EXPECT_EQ(image.format, stack::PixelFormat::kRgb8);
    EXPECT_EQ(ToGrey(image).bytes->size(), 640u * 480u);
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

}  // namespace
}  // namespace alula::scenarios::dataset
