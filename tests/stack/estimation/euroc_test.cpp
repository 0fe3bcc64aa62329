#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "stack/estimation/odometry.h"
#include "tests/stack/estimation/data.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {
namespace {

/// The VI sensor of EuRoC, as its sensor.yaml files give it.
Calibration EurocCalibration() {
  const auto pose = [](std::array<double, 12> m) {
    base::Mat3 R;
    R << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
    return Transform{Quat(R).normalized(), Vec3(m[3], m[7], m[11])};
  };
  Calibration c;
  CameraCalibration left, right;
  left.intrinsics = {
      752, 480, 458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}};
  right.intrinsics = {
      752, 480, 457.587, 456.134, 379.999, 255.238, {-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05, 0}};
  left.X_BC =
      pose({0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975, 0.999557249008, 0.0149672133247,
            0.025715529948, -0.064676986768, -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949});
  right.X_BC =
      pose({0.0125552670891, -0.999755099723, 0.0182237714554, -0.0198435579556, 0.999598781151, 0.0130119051815,
            0.0251588363115, 0.0453689425024, -0.0253898008918, 0.0179005838253, 0.999517347078, 0.00786212447038});
  c.cameras = {left, right};
  c.stereo = {{0, 1}};
  ImuCalibration imu;
  imu.rate = {200, 1};
  imu.noise = {1.6968e-4, 2.0e-3, 1.9393e-5, 3.0e-3, 0.1, 0.3, 7.8, 176};
  c.imu = imu;
  return c;
}

Image ReadPng(const std::filesystem::path& file) {
  const cv::Mat m = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  Image image;
  image.width = m.cols;
  image.height = m.rows;
  image.stride = m.cols;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(m.data, m.data + m.total());
  return image;
}

/// Real images of a vehicle on the ground, rotors spinning up at the end: it is not to drift.
TEST(Euroc, StandsStillWhileRotorsSpinUp) {
  const auto folder = DataFolder("euroc_v101_standstill");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no euroc_v101_standstill";
  cv::setNumThreads(1);
  const std::filesystem::path mav = *folder / "mav0";
  const std::vector<CsvRow> images = ReadCsv(mav / "cam0" / "data.csv");
  const std::int64_t origin = images.front().stamp;
  const std::vector<TimedImu> imu = ReadImu(mav / "imu0" / "data.csv", origin);
  StereoInertialOdometry odometry(EurocCalibration(), {}, {});
  std::size_t next = 0;
  std::optional<Vec3> first;
  double drift = 0.0, speed = 0.0;
  int frames = 0;
  for (const CsvRow& row : images) {
    const std::string name = std::to_string(row.stamp) + ".png";
    const auto left = mav / "cam0" / "data" / name, right = mav / "cam1" / "data" / name;
    if (!std::filesystem::exists(left) || !std::filesystem::exists(right)) continue;
    FrameInput input;
    input.seq = static_cast<std::uint32_t>(frames);
    input.stamp = Time{row.stamp - origin};
    input.left = ReadPng(left);
    input.right = ReadPng(right);
    while (next < imu.size() && (next == 0 || imu[next - 1].time < input.stamp)) input.imu.push_back(imu[next++]);
    const FrameResult result = odometry.Process(input);

    if (!result.initialised) continue;
    if (!first) first = result.state.X_OB.p;
    ++frames;
    drift = std::max(drift, (result.state.X_OB.p - *first).norm());
    speed = std::max(speed, result.state.v_OB.norm());
    EXPECT_EQ(result.reset_counter, 0U);
    EXPECT_GT(result.inliers, 40);
  }
  EXPECT_GT(frames, 40);
  EXPECT_LT(drift, 0.01);
  EXPECT_LT(speed, 0.05);
}

}  // namespace
}  // namespace alula::stack::estimation::test
