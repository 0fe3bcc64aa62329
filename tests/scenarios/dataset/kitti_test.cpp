// KITTI's odometry layout, from files that the test writes.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>

#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/layouts.h"
#include "scenarios/dataset/png.h"
#include "tests/scenarios/dataset/synthetic.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using base::Vec3;
using scenarios::testing::TemporaryFolder;
using testing::Complaint;

constexpr const char* kCalibration =
    "P0: 700 0 320 0 0 710 240 0 0 0 1 0\nP1: 700 0 320 -378 0 710 240 0 0 0 1 0\n"
    "P2: 700 0 320 42 0 710 240 7.1 0 0 1 0.02\nP3: 700 0 320 -336 0 710 240 7.1 0 0 1 0.02\n"
    "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n";

void WriteText(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

stack::Image Picture(int camera, int k) {
  return testing::RandomImage(22, 14, camera < 2 ? stack::PixelFormat::kGrey8 : stack::PixelFormat::kRgb8,
                              static_cast<std::uint64_t>(10 * camera + k));
}

/// Four images of each camera; the vehicle drives 1 m a step and turns left 0.1 rad a step (about −y of the camera).
void WriteSequence(const fs::path& folder, int cameras) {
  WriteText(folder / "calib.txt", kCalibration);
  WriteText(folder / "times.txt", "0.000000e+00\n1.000000e-01\n2.500000e-01\n3.000000e-01\n");
  std::string poses;
  for (int k = 0; k < 4; ++k) {
    const base::Mat3 R = base::Exp(Vec3(0, -0.1 * k, 0)).toRotationMatrix();
    const Vec3 p(0, 0, k);
    for (int r = 0; r < 3; ++r) {
      std::array<char, 128> row{};
      std::snprintf(row.data(), row.size(), "%.17g %.17g %.17g %.17g ", R(r, 0), R(r, 1), R(r, 2), p[r]);
      poses += row.data();
    }
    poses += '\n';
    for (int c = 0; c < cameras; ++c) {
      const fs::path images = folder / ("image_" + std::to_string(c));
      WriteText(images / ("00000" + std::to_string(k) + ".png"), EncodePng(Picture(c, k)));
    }
  }
  WriteText(folder / "poses.txt", poses);
}

TEST(Kitti, ReadsItsFourCamerasAndPoses) {
  const TemporaryFolder folder("kitti");
  WriteSequence(folder.path(), 4);
  EXPECT_EQ(LayoutOf(folder.path()), Layout::kKitti);
  const Recording recording = OpenRecording(folder.path());
  EXPECT_EQ(recording.layout, Layout::kKitti);
  ASSERT_EQ(recording.calibration.cameras.size(), 4u);
  EXPECT_EQ(recording.calibration.stereo, (std::array{0, 1}));
  EXPECT_FALSE(recording.calibration.imu);
  EXPECT_EQ(recording.missing_images, 0);
  const auto& cameras = recording.calibration.cameras;
  EXPECT_EQ(cameras[0].intrinsics.width, 22);
  EXPECT_EQ(cameras[0].intrinsics.fx, 700);
  EXPECT_EQ(cameras[0].intrinsics.fy, 710);
  EXPECT_EQ(cameras[0].rate, (base::Rate{10, 1}));
  // Projection of P_i and ours of the calibration agree, for points that lie before the vehicle (x forward, y left).
  for (const Vec3& p_B : {Vec3(5, 1, 0.5), Vec3(9, -2, -1)}) {
    const Vec3 p_C0(-p_B.y(), -p_B.z(), p_B.x());
    const double columns[4][3] = {{0, 0, 0}, {-378, 0, 0}, {42, 7.1, 0.02}, {-336, 7.1, 0.02}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 p_C = cameras[i].X_BC.Inverse() * p_B;
      const double w = p_C0.z() + columns[i][2];
      EXPECT_NEAR(700 * p_C.x() / p_C.z() + 320, (700 * p_C0.x() + 320 * p_C0.z() + columns[i][0]) / w, 1e-9);
      EXPECT_NEAR(710 * p_C.y() / p_C.z() + 240, (710 * p_C0.y() + 240 * p_C0.z() + columns[i][1]) / w, 1e-9);
    }
  }
  EXPECT_NEAR(cameras[1].X_BC.p.y(), -0.54, 1e-12);  // to the right
  EXPECT_EQ(cameras[0].kind, stack::CameraKind::kGrey);
  EXPECT_EQ(cameras[3].kind, stack::CameraKind::kColour);
  for (std::size_t c = 0; c < 4; ++c) {
    ASSERT_EQ(recording.images[c].size(), 4u);
    const stack::Image image = LoadImage(recording.images[c][2], cameras[c]);
    EXPECT_EQ(testing::Pixels(image), testing::Pixels(Picture(static_cast<int>(c), 2)));
    EXPECT_EQ(image.exposure_start, base::Time{250'000'000});
  }
  ASSERT_EQ(recording.truth.size(), 4u);
  const std::vector<base::StampedPose> poses = TrueTrajectory(recording);
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_EQ(poses[3].time, StampsOf(recording.images[0])[3]);
  EXPECT_EQ(poses[3].X_FS.p, recording.truth[3].X_WB.p);
  for (int k = 0; k < 4; ++k) {
    const BodyTruth& truth = recording.truth[static_cast<std::size_t>(k)];
    EXPECT_EQ(truth.time, recording.images[0][static_cast<std::size_t>(k)].captured);
    EXPECT_LT((truth.X_WB.p - Vec3(k, 0, 0)).norm(), 1e-12);                                // forward is x
    EXPECT_LT(base::Log(truth.X_WB.q.conjugate() * base::FromYaw(0.1 * k)).norm(), 1e-12);  // left is positive
  }
}

TEST(Kitti, PosesMayLieWhereKittiShipsThem) {
  const TemporaryFolder folder("kitti_shipped");
  const fs::path sequence = folder.path() / "sequences" / "07";
  WriteSequence(sequence, 2);
  fs::create_directories(folder.path() / "poses");
  fs::rename(sequence / "poses.txt", folder.path() / "poses" / "07.txt");
  EXPECT_EQ(OpenRecording(sequence).truth.size(), 4u);
  EXPECT_EQ(OpenRecording(sequence / "").truth.size(), 4u);
  fs::remove(folder.path() / "poses" / "07.txt");
  EXPECT_TRUE(OpenRecording(sequence).truth.empty());
}

TEST(Kitti, SurvivesMissingImagesAndCameras) {
  const TemporaryFolder folder("kitti_gaps");
  WriteSequence(folder.path(), 4);
  fs::remove(folder.path() / "image_1" / "000000.png");
  fs::remove(folder.path() / "image_1" / "000002.png");
  fs::remove_all(folder.path() / "image_0");
  WriteText(folder.path() / "image_2" / "000004.png", "an image without a stamp");
  const Recording recording = OpenRecording(folder.path());
  EXPECT_EQ(recording.missing_images, 2);
  ASSERT_EQ(recording.images.size(), 3u);
  EXPECT_EQ(recording.images[0].size(), 2u);
  EXPECT_EQ(recording.images[0][0].captured, base::Time{100'000'000});
  EXPECT_EQ(recording.images[1].size(), 4u);
  EXPECT_EQ(recording.calibration.stereo, (std::array{1, 2}));  // the colour pair: image_2 and image_3
  EXPECT_EQ(recording.calibration.cameras[1].name, "image_2");
}

TEST(Kitti, BrokenFilesAreNamedWithTheirLine) {
  struct Bad {
    const char* file;
    const char* text;  // null: the file is taken away
    const char* message;
  };
  const std::vector<Bad> table = {
      {"calib.txt", "P0: 1 2 3\n", "calib.txt:1: P0: has 3 numbers"},
      {"calib.txt", "# head\nP0: 700 0 320 0 0 710 240 0 0 0 1 x\n", "calib.txt:2: P0: `x`"},
      {"calib.txt", "P0: 0 0 320 0 0 710 240 0 0 0 1 0\n", "calib.txt:1: P0: is no projection"},
      {"calib.txt", "P0: 7 0 3 0 0 7 2 0 0 0 1 0\nP0: 7 0 3 0 0 7 2 0 0 0 1 0\n",
       "calib.txt:2: P0: stands there twice"},
      {"calib.txt", "Tr: 1\n", "calib.txt: has no row P0"},
      {"times.txt", "0\n0\n", "times.txt:2: timestamp: is not later"},
      {"times.txt", "0\nnan\n", "times.txt:2: timestamp: `nan`"},
      {"times.txt", nullptr, "times.txt: cannot be read"},
      {"poses.txt", "1 0 0 0 0 1 0 0 0 0 1\n", "poses.txt:1: pose: has 11 numbers"},
      {"poses.txt", "2 0 0 0 0 1 0 0 0 0 1 0\n", "poses.txt:1: pose: is no rotation"},
      {"poses.txt", "1 0 0 0 0 1 0 0 0 0 -1 0\n", "poses.txt:1: pose: is no rotation"},
      {"image_0/000000.png", "text", "000000.png: is no PNG"},
  };
  for (const Bad& bad : table) {
    const TemporaryFolder folder("kitti_broken");
    WriteSequence(folder.path(), 2);
    fs::remove(folder.path() / bad.file);
    if (bad.text != nullptr) WriteText(folder.path() / bad.file, bad.text);
    const std::string said = Complaint([&] { OpenRecording(folder.path()); });
    EXPECT_NE(said.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << said;
  }
  const TemporaryFolder folder("kitti_broken");
  WriteSequence(folder.path(), 2);
  std::ofstream(folder.path() / "poses.txt", std::ios::app) << "1 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_NE(Complaint([&] { OpenRecording(folder.path()); }).find("poses.txt:5: pose: has no stamp"),
            std::string::npos);
  // An image of another size is found when it is loaded.
  WriteSequence(folder.path(), 2);
  WriteText(folder.path() / "image_1" / "000003.png",
            EncodePng(testing::RandomImage(23, 14, stack::PixelFormat::kGrey8, 1)));
  const Recording recording = OpenRecording(folder.path());
  EXPECT_NE(Complaint([&] { LoadImage(recording.images[1][3], recording.calibration.cameras[1]); }).find("23x14"),
            std::string::npos);
}

TEST(Layouts, WhatIsNoneIsSaidSo) {
  const TemporaryFolder folder("layouts");
  EXPECT_EQ(LayoutOf(folder.path()), std::nullopt);
  const std::string said = Complaint([&] { OpenRecording(folder.path()); });
  EXPECT_NE(said.find("holds no recording"), std::string::npos);
  EXPECT_EQ(said.find('\n'), std::string::npos);
  EXPECT_NE(Complaint([&] { OpenRecording(folder.path() / "nowhere"); }).find("is no folder"), std::string::npos);
  for (const auto& [layout, name] :
       {std::pair{Layout::kEuroc, "EuRoC ASL"}, std::pair{Layout::kKitti, "KITTI odometry"},
        std::pair{Layout::kTum, "TUM RGB-D"}}) {
    EXPECT_EQ(NameOf(layout), name);
  }
}

}  // namespace
}  // namespace alula::scenarios::dataset
