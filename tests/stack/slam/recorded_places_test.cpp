#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>

#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "stack/slam/keyframe_database.h"
#include "stack/slam/relative_pose.h"

namespace alula::stack::slam {
namespace {

using base::Quat;
using base::Transform;
using base::Vec3;

constexpr double kDegree = std::numbers::pi / 180;

std::optional<std::filesystem::path> LoopPairs() {
  const char* root = std::getenv("ALULA_DATA");
  if (root == nullptr || *root == '\0') return std::nullopt;
  const auto folder = std::filesystem::path(root) / "euroc_loop_pairs";
  return std::filesystem::exists(folder) ? std::optional(folder) : std::nullopt;
}

CameraCalibration Camera(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.starts_with("%YAML:1.0")) text.erase(0, text.find('\n') + 1);  // OpenCV's head, which is no YAML
  // These two files say camera_id where EuRoC's others say sensor_type.
  if (const auto at = text.find("camera_id:"); at != std::string::npos) text.replace(at, 9, "sensor_type");
  return scenarios::dataset::ReadCameraYaml(text, file.string());
}

Image Picture(const std::filesystem::path& file) {
  return scenarios::dataset::ToImage(scenarios::dataset::ReadPng(file), file.string());
}

/// Body poses of the four (ALULA_DATA's README): 0 and 1, 2 and 3 are one place each.
const std::array<Transform, 4> kPoses{
    Transform{Quat(.338337, .608466, -.535476, .478082), Vec3(1.573832, 2.023348, 1.738755)},
    Transform{Quat(.478634, .415595, -.700197, .328505), Vec3(1.872115, 1.786064, 1.586159)},
    Transform{Quat(.3394, -.672895, -.492724, -.435018), Vec3(-.662997, -.495046, 1.347300)},
    Transform{Quat(.39266, -.590667, -.58023, -.400326), Vec3(-.345638, -.501712, 1.320441)}};

struct Places {
  std::array<PlaceView, 4> views;
  Transform X_BC;
};

Places Load(const std::filesystem::path& folder) {
  const CameraCalibration left = Camera(folder / "sensorLeft.yaml"), right = Camera(folder / "sensorRight.yaml");
  const features::StereoRig rig{left.intrinsics, right.intrinsics, left.X_BC.Inverse() * right.X_BC};
  Places places;
  places.X_BC = left.X_BC;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string end = "_img_" + std::to_string(i) + ".png";
    places.views[i] = ViewOf(rig, Picture(folder / ("left" + end)), Picture(folder / ("right" + end)), {});
    const Transform X_WC = kPoses[i] * left.X_BC;
    places.views[i].up_C = X_WC.q.conjugate() * Vec3::UnitZ();
  }
  return places;
}

TEST(RecordedPlaces, AreKnownAgainAndNoneFalsely) {
  const auto folder = LoopPairs();
  if (!folder) GTEST_SKIP() << "ALULA_DATA has no euroc_loop_pairs";
  const Places places = Load(*folder);
  for (const bool gravity : {false, true}) {
    RelativePoseConfig config;
    config.use_gravity = gravity;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (i == j) continue;
        const RelativePose pose = EstimateRelativePose(places.views[i], places.views[j], config, 1);
        const Transform truth = (kPoses[i] * places.X_BC).Inverse() * (kPoses[j] * places.X_BC);
        const double metres = (pose.X_AB.p - truth.p).norm();
        const double degrees = base::Log(pose.X_AB.q.conjugate() * truth.q).norm() / kDegree;
        std::printf("%zu-%zu%s: %3zu matches %3zu inliers, share %.2f spread %.2f, %s; off by %.3f m %.2f deg\n", i, j,
                    gravity ? " with gravity" : "", pose.matches.size(), pose.inliers.size(), pose.share, pose.spread,
                    pose.accepted ? "accepted" : pose.reason.c_str(), metres, degrees);
        EXPECT_EQ(pose.accepted, i / 2 == j / 2);
        if (i / 2 != j / 2) continue;
        EXPECT_LT(metres, 0.1);
        EXPECT_LT(degrees, 2.0);
      }
    }
  }
}

/// The vocabulary that comes with the source, which has seen none of these, ranks the right one first.
TEST(RecordedPlaces, AreFoundByTheirWords) {
  const auto folder = LoopPairs();
  if (!folder) GTEST_SKIP() << "ALULA_DATA has no euroc_loop_pairs";
  const Places places = Load(*folder);
  const Vocabulary vocabulary =
      LoadVocabulary(std::filesystem::path(ALULA_SOURCE_DIR) / "stack" / "slam" / "assets" / "vocabulary.bin");
  KeyframeDatabase database;
  for (KeyframeId i = 0; i < 4; ++i) database.Add(i, vocabulary.WordsOf(places.views[i]));
  for (KeyframeId i = 0; i < 4; ++i) {
    const std::vector<KeyframeId> itself{i};
    const auto found = database.Query(*database.Find(i), itself);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].id, i ^ 1U);
    EXPECT_GT(found[0].score, 1.3 * found[1].score);
    std::printf("%d: %.3f, next best %.3f\n", static_cast<int>(i), found[0].score, found[1].score);
  }
}

}  // namespace
}  // namespace alula::stack::slam
