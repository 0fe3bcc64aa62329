#include "stack/estimation/odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "base/hash.h"
#include "tests/stack/estimation/wall.h"

namespace alula::stack::estimation::test {
namespace {

/// A vehicle that stands before the wall; frame by frame.
class Standing : public ::testing::Test {
 protected:
  Standing() : odometry(TrueCalibration(), {}, {base::FromYaw(1.0), Vec3(1, 2, 3)}) { cv::setNumThreads(1); }
  /// A camera 3.5 m before the wall and `x` m to the right.
  static Image SeenFrom(double x) { return Wall().Seen(kCamera, {Quat::Identity(), Vec3(x, 0, -Wall::kDistance)}); }
  static Image Black() { return Wall::Black(kCamera); }
  FrameResult Next(const Image& l, const Image& r) {
    FrameInput input;
    input.seq = seq;
    input.stamp = Time{50'000'000LL * seq++};
    input.left = l;
    input.right = r;
    while (next_imu <= input.stamp) {
      const Vec3 gyro = Vec3(0.002, -0.001, 0.003) + 2.4e-3 * random.GaussianVec3();
      input.imu.push_back({next_imu, gyro, Vec3(0, 0, base::kGravity) + 0.028 * random.GaussianVec3()});
      next_imu += base::Milliseconds(5);
    }
    return odometry.Process(input);
  }
  inline static const CameraIntrinsics kCamera = TrueCalibration().cameras[0].intrinsics;
  static constexpr double kBaseline = 0.11;  // m
  Odometry odometry;
  Image left = SeenFrom(0), right = SeenFrom(kBaseline);
  base::RandomStream random{3, "test/standing"};
  std::uint32_t seq = 0;
  Time next_imu;
};

TEST_F(Standing, WaitsForStandstillThenStartsAtThePoseThatItWasTold) {
  for (int i = 0; i < 10; ++i) {
    const FrameResult r = Next(SeenFrom(0.02 * i), SeenFrom(0.02 * i + kBaseline));
    EXPECT_FALSE(r.initialised);
    EXPECT_EQ(r.note, i == 0 ? "waiting for standstill" : "moving");
  }
  FrameResult r;
  int frames = 0;
  for (; frames < 40 && !r.initialised; ++frames) r = Next(left, right);
  EXPECT_NEAR(frames, 22, 2);
  for (int i = 0; i < 20; ++i) r = Next(left, right);
  EXPECT_EQ(r.note, "");
  EXPECT_GT(r.inliers, 60);
  EXPECT_EQ(r.features.size(), static_cast<std::size_t>(r.tracked));
  EXPECT_LT((r.state.X_OB.p - Vec3(1, 2, 3)).norm(), 0.01);
  EXPECT_NEAR(base::Yaw(r.state.X_OB.q), 1.0, 1e-3);
  EXPECT_LT(r.state.v_OB.norm(), 0.02);
  EXPECT_LT((r.state.gyro_bias - Vec3(0.002, -0.001, 0.003)).norm(), 1e-3);
}

TEST_F(Standing, ResetsAfterALongBlindStretchAndGoesOn) {
  FrameResult r;
  for (int i = 0; i < 40; ++i) r = Next(left, right);
  ASSERT_TRUE(r.initialised);
  for (int i = 0; i < 60; ++i) r = Next(Black(), Black());  // three seconds: the IMU alone
  EXPECT_EQ(r.reset_counter, 0U);
  EXPECT_EQ(r.note, "few corners: mostly inertial");
  EXPECT_LT((r.state.X_OB.p - Vec3(1, 2, 3)).norm(), 0.5);
  const double sigma = std::sqrt(r.pose_covariance.topLeftCorner<3, 3>().trace());
  EXPECT_GT(sigma, 0.01);  // and it says so
  for (int i = 0; i < 40; ++i) r = Next(Black(), Black());
  EXPECT_GE(r.reset_counter, 1U);
  const std::uint32_t resets = r.reset_counter;
  for (int i = 0; i < 40; ++i) r = Next(left, right);
  EXPECT_EQ(r.reset_counter, resets);
  EXPECT_GT(r.inliers, 60);
  EXPECT_TRUE(r.state.X_OB.p.allFinite());
  EXPECT_LT(r.state.v_OB.norm(), 0.3);
}

TEST_F(Standing, ComesBackFromAShortBlindStretch) {
  FrameResult r;
  for (int i = 0; i < 40; ++i) r = Next(left, right);
  for (int i = 0; i < 20; ++i) r = Next(Black(), Black());
  for (int i = 0; i < 20; ++i) r = Next(left, right);
  EXPECT_EQ(r.reset_counter, 0U);
  EXPECT_LT((r.state.X_OB.p - Vec3(1, 2, 3)).norm(), 0.05);
  EXPECT_LT(r.state.v_OB.norm(), 0.1);
}

TEST_F(Standing, IgnoresAnImageThatIsNotNewer) {
  FrameResult r;
  for (int i = 0; i < 40; ++i) r = Next(left, right);
  const base::Transform before = r.state.X_OB;
  FrameInput again;
  again.stamp = r.state.stamp;
  again.left = left;
  again.right = right;
  r = odometry.Process(again);
  EXPECT_EQ(r.note, "image is not newer than the one before");
  EXPECT_EQ(r.state.X_OB.p, before.p);
}

TEST_F(Standing, GivesTheSameBitsTwice) {
  const auto run = [this] {
    base::RollingHash hash;
    Odometry fresh(TrueCalibration(), {}, {});
    for (int i = 0; i < 60; ++i) {
      FrameInput input;
      input.seq = static_cast<std::uint32_t>(i);
      input.stamp = Time{50'000'000LL * i};
      input.left = left;
      input.right = right;
      for (int k = 0; k < 10; ++k) {
        input.imu.push_back({Time{50'000'000LL * (i - 1) + 5'000'000LL * (k + 1)}, Vec3(1e-3 * (k - 4.5), 0, 0),
                             Vec3(0.01 * (k % 3), 0, base::kGravity)});
      }
      const FrameResult r = fresh.Process(input);
      hash.Add(r.state.X_OB);
      hash.Add(r.state.v_OB);
      for (int d = 0; d < 6; ++d) hash.Add(r.pose_covariance(d, d));
    }
    return hash.value();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace alula::stack::estimation::test
