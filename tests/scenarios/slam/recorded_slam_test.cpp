// The whole estimator on recordings of others, against what their makers give as truth.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "scenarios/dataset/layouts.h"
#include "scenarios/slam/recording_feed.h"
#include "scenarios/slam/slam_report.h"
#include "tests/stack/estimation/data.h"

namespace alula::scenarios::slam {
namespace {

using stack::estimation::test::DataFolder;

nlohmann::json Figures(const std::string& folder, const Variant& variant) {
  const dataset::Recording recording = dataset::OpenRecording(folder);
  auto results = FeedRecording(recording, {variant}, [](base::Time) {});
  const auto report = ToJson(Judge("recording", 1, std::move(results), TruthOf(recording)));
  const nlohmann::json figures = report["estimators"][0]["figures"];
  for (const char* key : {"ate_se3_online_m", "ate_se3_final_m", "end_error_online_percent", "end_error_final_percent"})
    std::printf("%s %.4f\n", key, figures[key].get<double>());
  return figures;
}

/// A car with a pair of cameras and nothing else.
TEST(RecordedSlam, StereoAloneOnAStreet) {
  const auto folder = DataFolder("kitti_stereo");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no kitti_stereo";
  const nlohmann::json figures = Figures(*folder, {"slam", {}});
  EXPECT_EQ(figures["completeness_online"], 1.0);
  EXPECT_EQ(figures["resets"], 0);
  EXPECT_LT(figures["end_error_online_percent"], 1.5);
  EXPECT_LT(figures["end_error_final_percent"], 1.5);
}

/// A hand-held depth camera; its truth is an estimate itself.
TEST(RecordedSlam, DepthCameraAloneInARoom) {
  const auto folder = DataFolder("rgbd_room");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no rgbd_room";
  const nlohmann::json figures = Figures(*folder, {"slam", {}});
  EXPECT_EQ(figures["completeness_online"], 1.0);
  EXPECT_EQ(figures["resets"], 0);
  EXPECT_LT(figures["ate_se3_online_m"], 0.05);
  EXPECT_LT(figures["ate_se3_final_m"], 0.05);
}

/// One camera and an IMU that stand while the rotors start: no scale can be seen, and nothing may move.
TEST(RecordedSlam, OneCameraAndAnImuStandStill) {
  const auto folder = DataFolder("euroc_v101_standstill");
  if (!folder) GTEST_SKIP() << "ALULA_DATA is not set: no euroc_v101_standstill";
  Variant variant{"mono", {}};
  variant.config.odometry.sensors.depth = stack::estimation::DepthChoice::kNone;
  variant.config.map.enabled = false;
  const nlohmann::json figures = Figures(*folder, variant);
  EXPECT_EQ(figures["resets"], 0);
  EXPECT_LT(figures["ate_se3_online_m"], 0.05);
}

}  // namespace
}  // namespace alula::scenarios::slam
