// EuRoC's own recordings through our reader.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "scenarios/dataset/euroc_reader.h"
#include "scenarios/dataset/image_file.h"

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
  const Recording recording = ReadEuroc(*folder);
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

}  // namespace
}  // namespace alula::scenarios::dataset
