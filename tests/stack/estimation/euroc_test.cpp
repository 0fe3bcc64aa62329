#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "scenarios/dataset/euroc_reader.h"
#include "scenarios/dataset/image_file.h"
#include "stack/estimation/odometry.h"
#include "tests/stack/estimation/data.h"
#include "tests/stack/estimation/flight.h"

namespace alula::stack::estimation::test {
namespace {

/// Real images of a vehicle on the ground, rotors spinning up at the end: it is not to drift.
TEST(Euroc, StandsStillWhileRotorsSpinUp) {
  const auto folder = DataFolder("euroc_v101_standstill");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no euroc_v101_standstill";
  cv::setNumThreads(1);
  namespace dataset = scenarios::dataset;
  const dataset::Recording recording = dataset::ReadEuroc(*folder);
  Calibration calibration = recording.calibration;
  ImuNoise& noise = calibration.imu->noise;  // what sensor.yaml does not say of the ADIS16448
  noise.gyro_turn_on_bias = 0.1;
  noise.accelerometer_turn_on_bias = 0.3;
  noise.gyro_range = 7.8;
  noise.accelerometer_range = 176;
  const base::Duration epoch = recording.images[0].front().captured - Time{};
  Odometry odometry(calibration, {}, {});
  std::size_t next = 0;
  std::optional<Vec3> first;
  double drift = 0.0, speed = 0.0;
  int frames = 0;
  for (const dataset::ImageFile& left : recording.images[0]) {
    const auto right = std::find_if(recording.images[1].begin(), recording.images[1].end(),
                                    [&](const dataset::ImageFile& r) { return r.captured == left.captured; });
    if (right == recording.images[1].end()) continue;
    FrameInput input;
    input.seq = static_cast<std::uint32_t>(frames);
    input.stamp = left.captured - epoch;
    input.left = dataset::LoadImage(left, calibration.cameras[0]);
    input.right = dataset::LoadImage(*right, calibration.cameras[1]);
    for (; next < recording.imu.size() && (next == 0 || recording.imu[next - 1].time < left.captured); ++next) {
      const dataset::ImuReading& reading = recording.imu[next];
      input.imu.push_back({reading.time - epoch, reading.sample.angular_velocity, reading.sample.specific_force});
    }
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
