#include "stack/slam/frame_assembler.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace alula::stack::slam {
namespace {

using base::Milliseconds;
using base::Time;

Calibration TwoEyesAndAnImu() {
  Calibration calibration;
  calibration.cameras.resize(2);
  calibration.cameras[0].sensor = SensorId{10};
  calibration.cameras[0].time_offset = Milliseconds(3);
  calibration.cameras[1].sensor = SensorId{11};
  calibration.stereo = {0, 1};
  calibration.imu.emplace();
  calibration.imu->sensor = SensorId{1};
  return calibration;
}

Measurement ImageOf(int sensor, std::uint32_t seq, std::int64_t ms) {
  return {SensorId(static_cast<std::uint16_t>(sensor)), seq, Time{} + Milliseconds(ms), {}, Image{}};
}
Measurement ImuAt(std::int64_t ms, int sensor = 1) {
  return {SensorId(static_cast<std::uint16_t>(sensor)), 0, Time{} + Milliseconds(ms), {}, ImuSample{}};
}

TEST(FrameAssembler, WaitsForBothEyesAndForTheSamples) {
  FrameAssembler frames(TwoEyesAndAnImu());
  frames.Add(ImuAt(0));
  frames.Add(ImageOf(10, 7, 50));
  EXPECT_FALSE(frames.Next());
  frames.Add(ImageOf(11, 7, 50));
  EXPECT_FALSE(frames.Next());  // stamped 53 ms of IMU time
  frames.Add(ImuAt(50));
  EXPECT_FALSE(frames.Next());
  frames.Add(ImuAt(55));
  frames.Add(ImuAt(60));
  const auto frame = frames.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->seq, 7U);
  EXPECT_EQ(frame->stamp, Time{} + Milliseconds(53));
  ASSERT_EQ(frame->imu.size(), 3U);  // up to the first at or after the stamp
  EXPECT_FALSE(frames.Next());       // given once
}

TEST(FrameAssembler, ASkippedFramesSamplesGoWithTheNext) {
  FrameAssembler frames(TwoEyesAndAnImu());
  for (int ms = 0; ms <= 120; ms += 5) frames.Add(ImuAt(ms));
  for (const int seq : {0, 1}) {
    for (const int eye : {10, 11}) frames.Add(ImageOf(eye, static_cast<std::uint32_t>(seq), 50 * seq + 47));
  }
  const auto first = frames.Next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->imu.size(), 11U);
  const auto second = frames.Next();  // the first was not processed
  ASSERT_TRUE(second);
  EXPECT_EQ(second->imu.size(), 21U);
  frames.Consume(*second);
  for (const int eye : {10, 11}) frames.Add(ImageOf(eye, 2, 110));
  const auto third = frames.Next();
  ASSERT_TRUE(third);
  EXPECT_EQ(third->imu.front().time, Time{} + Milliseconds(105));
}

TEST(FrameAssembler, APairThatLacksAnEyeIsPassedOver) {
  FrameAssembler frames(TwoEyesAndAnImu());
  for (int ms = 0; ms <= 200; ms += 5) frames.Add(ImuAt(ms));
  frames.Add(ImageOf(10, 0, 40));
  frames.Add(ImageOf(12, 0, 40));  // some other camera
  EXPECT_FALSE(frames.Next());
  frames.Add(ImageOf(10, 1, 90));
  frames.Add(ImageOf(11, 1, 90));
  const auto frame = frames.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->seq, 1U);
}

Calibration WithoutImu() {
  Calibration calibration = TwoEyesAndAnImu();
  calibration.imu.reset();
  return calibration;
}

TEST(FrameAssembler, WithoutAnImuAPairIsEnough) {
  FrameAssembler frames(WithoutImu());
  frames.Add(ImageOf(10, 0, 40));
  EXPECT_FALSE(frames.Next());
  frames.Add(ImageOf(11, 0, 40));
  const auto frame = frames.Next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->imu.empty());
}

TEST(FrameAssembler, APictureWaitsForItsDepth) {
  Calibration calibration = WithoutImu();
  calibration.stereo.reset();
  for (CameraCalibration& camera : calibration.cameras) {
    camera.intrinsics.width = 4;
    camera.intrinsics.height = 3;
    camera.intrinsics.fx = camera.intrinsics.fy = 4.0;
  }
  calibration.cameras[1].kind = CameraKind::kDepth;
  FrameAssembler frames(calibration);
  frames.Add(ImageOf(10, 0, 40));
  EXPECT_FALSE(frames.Next());
  DepthImage depth;
  depth.width = 4;
  depth.height = 3;
  depth.millimetres = std::make_shared<const std::vector<std::uint16_t>>(12, std::uint16_t{1500});
  frames.Add({SensorId(11), 0, Time{} + Milliseconds(40), {}, depth});
  const auto frame = frames.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->depth.width, 4);
  EXPECT_FALSE(frame->right.bytes);
}

TEST(FrameAssembler, OneCameraComesWithItsSamples) {
  Calibration calibration = TwoEyesAndAnImu();
  calibration.stereo.reset();
  calibration.cameras.pop_back();
  FrameAssembler frames(calibration);
  frames.Add(ImageOf(10, 0, 40));
  EXPECT_FALSE(frames.Next());
  for (int ms = 0; ms <= 50; ms += 5) frames.Add(ImuAt(ms));
  const auto frame = frames.Next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->imu.size(), 10U);  // up to 45 ms for a stamp of 43
}

TEST(FrameAssembler, SaysWhatIsMissing) {
  Calibration alone = WithoutImu();
  alone.stereo.reset();
  EXPECT_THROW(FrameAssembler{alone}, base::InputError);
  Calibration blind = TwoEyesAndAnImu();
  blind.stereo.reset();
  blind.cameras.clear();
  EXPECT_THROW(FrameAssembler{blind}, base::InputError);
}

}  // namespace
}  // namespace alula::stack::slam
