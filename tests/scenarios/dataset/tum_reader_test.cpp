// TUM's RGB-D layout read: our own exports, and recordings with a camera.yaml.
#include "scenarios/dataset/tum_reader.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scenarios/dataset/dataset_writer.h"
#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/layouts.h"
#include "scenarios/dataset/png.h"
#include "stack/features/depth_registration.h"
#include "tests/scenarios/dataset/jpeg_encoder.h"
#include "tests/scenarios/dataset/synthetic.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using base::Vec3;
using scenarios::testing::TemporaryFolder;
using testing::Complaint;

base::Time At(int milliseconds) { return base::Time{} + base::Milliseconds(milliseconds); }

stack::DepthImage Depth(int width, int height, std::uint16_t first) {
  std::vector<std::uint16_t> mm;
  for (int i = 0; i < width * height; ++i) mm.push_back(static_cast<std::uint16_t>(first + 7 * i));
  return {.width = width,
          .height = height,
          .exposure_start = {},
          .exposure = {},
          .millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(mm))};
}

TEST(TumReader, ReadsWhatTheWriterWrote) {
  const TemporaryFolder folder("tum_back");
  const stack::Calibration calibration = testing::EverySensor();
  const stack::CameraCalibration &colour = calibration.cameras[0], &depth = calibration.cameras[4];
  const auto writer = MakeTumWriter(folder.path(), calibration, "test");
  std::vector<stack::Image> images;
  std::vector<BodyTruth> truth;
  base::RandomStream random(2, "tum");
  for (int k = 0; k < 5; ++k) {
    images.push_back(testing::RandomImage(38, 16, stack::PixelFormat::kRgb8, static_cast<std::uint64_t>(k)));
    writer->Add({colour.sensor, 0, At(100 * k), At(500), images.back()});
    if (k != 3) writer->Add({depth.sensor, 0, At(100 * k + 4), At(500), Depth(37, 16, static_cast<std::uint16_t>(k))});
    BodyTruth state;
    state.time = At(100 * k);
    state.X_WB = {base::Exp(random.GaussianVec3()), random.GaussianVec3()};
    truth.push_back(state);
    writer->Add(state);
  }
  writer->Finish();

  const Recording back = OpenRecording(folder.path());
  EXPECT_EQ(back.layout, Layout::kTum);
  ASSERT_EQ(back.calibration.cameras.size(), 2u);
  EXPECT_EQ(back.calibration.cameras[0].intrinsics.fx, colour.intrinsics.fx);
  EXPECT_EQ(back.calibration.cameras[0].rate, colour.rate);
  EXPECT_EQ(back.calibration.cameras[1].kind, stack::CameraKind::kDepth);
  ASSERT_TRUE(back.depth);
  EXPECT_EQ(back.depth->values_per_metre, 5000);
  EXPECT_EQ(back.depth->of_picture, (std::vector<std::optional<std::size_t>>{0, 1, 2, std::nullopt, 3}));
  EXPECT_FALSE(back.calibration.stereo);
  const base::Transform X_CD = colour.X_BC.Inverse() * depth.X_BC;
  const base::Transform read = back.calibration.cameras[0].X_BC.Inverse() * back.calibration.cameras[1].X_BC;
  EXPECT_LT((read.p - X_CD.p).norm(), 1e-14);
  EXPECT_LT(base::Log(read.q.conjugate() * X_CD.q).norm(), 1e-14);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(testing::Pixels(LoadImage(back.images[0][k], back.calibration.cameras[0])), testing::Pixels(images[k]));
    // The poses of the camera are the same, whatever body they are told of.
    EXPECT_EQ(back.truth[k].time, truth[k].time);
    const base::Transform was = truth[k].X_WB * colour.X_BC;
    const base::Transform is = back.truth[k].X_WB * back.calibration.cameras[0].X_BC;
    EXPECT_LT((was.p - is.p).norm(), 1e-14);
    EXPECT_LT(base::Log(was.q.conjugate() * is.q).norm(), 1e-14);
  }
  const stack::DepthImage first =
      LoadDepth(back.images[1][0], back.calibration.cameras[1], back.depth->values_per_metre);
  EXPECT_EQ(*first.millimetres, *Depth(37, 16, 0).millimetres);
  EXPECT_FALSE(stack::features::Registered(back.calibration.cameras[0], back.calibration.cameras[1]));
}

/// Three JPEG pictures and two depth images of 4x3 pixels, with a camera.yaml.
void WriteSequence(const fs::path& folder, const std::string& more_yaml = "") {
  fs::create_directories(folder / "rgb");
  fs::create_directories(folder / "depth");
  std::ofstream(folder / "camera.yaml") << "# pinhole\nwidth: 4\nheight: 3\nfx: 5\nfy: 6\ncx: 2\ncy: 1.5\n"
                                        << "depth_scale: 1000   # millimetres\nrate_hz: 30\n"
                                        << more_yaml;
  std::ofstream(folder / "rgb.txt") << "# timestamp filename\n0.0 rgb/0.jpg\n0.033333 rgb/1.jpg\n0.066667 rgb/2.jpg\n";
  std::ofstream(folder / "depth.txt") << "0.01 depth/0.png\n0.0650 depth/1.png\n";
  std::ofstream(folder / "groundtruth.txt") << "# X_WC\n0.0 1 2 3 0 0 0 1\n0.033333 1 2 3.5 0 0 0 1\n";
  for (int k = 0; k < 3; ++k) {
    std::ofstream(folder / "rgb" / (std::to_string(k) + ".jpg"), std::ios::binary)
        << testing::EncodeJpeg(testing::RandomImage(4, 3, stack::PixelFormat::kRgb8, 1));
    if (k < 2) {
      std::ofstream(folder / "depth" / (std::to_string(k) + ".png"), std::ios::binary)
          << EncodePng16(4, 3, std::vector<std::uint16_t>(12, 1234));
    }
  }
}

TEST(TumReader, ReadsJpegAndACameraYaml) {
  const TemporaryFolder folder("tum_jpeg");
  WriteSequence(folder.path());
  const Recording recording = OpenRecording(folder.path());
  const auto& cameras = recording.calibration.cameras;
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].intrinsics.fy, 6);
  EXPECT_EQ(cameras[0].rate, (base::Rate{30, 1}));
  EXPECT_EQ(cameras[0].kind, stack::CameraKind::kColour);
  EXPECT_TRUE(stack::features::Registered(cameras[0], cameras[1]));
  EXPECT_EQ(recording.depth->of_picture, (std::vector<std::optional<std::size_t>>{0, std::nullopt, 1}));
  EXPECT_EQ(LoadImage(recording.images[0][1], cameras[0]).format, stack::PixelFormat::kRgb8);
  EXPECT_EQ(LoadDepth(recording.images[1][0], cameras[1], recording.depth->values_per_metre).millimetres->at(5), 1234);
  // The camera looks along the world's z: forward is z, left is −x, up is −y.
  ASSERT_EQ(recording.truth.size(), 2u);
  const base::Transform& X_WB = recording.truth[0].X_WB;
  EXPECT_LT((X_WB.p - Vec3(1, 2, 3)).norm(), 1e-14);
  EXPECT_LT((X_WB.q * Vec3(1, 0, 0) - Vec3(0, 0, 1)).norm(), 1e-14);
  EXPECT_LT((X_WB.q * Vec3(0, 1, 0) - Vec3(-1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((X_WB.q * Vec3(0, 0, 1) - Vec3(0, -1, 0)).norm(), 1e-14);
}

TEST(TumReader, TheDepthCameraMayBeAnother) {
  const TemporaryFolder folder("tum_extrinsics");
  WriteSequence(folder.path(),
                "distortion: [0.1, -0.2, 0.001, 0.002, 0.3]\ndepth: {fx: 7, fy: 8, cx: 1, cy: 1}\n"
                "T_CD:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, -0.025, 0, 1, 0, 0.001, 0, 0, 1, 0.002, 0, 0, 0, 1]\n");
  const Recording recording = OpenRecording(folder.path());
  const auto& cameras = recording.calibration.cameras;
  EXPECT_EQ(cameras[0].intrinsics.distortion[4], 0.3);
  EXPECT_EQ(cameras[1].intrinsics.fx, 7);
  EXPECT_EQ(cameras[1].intrinsics.distortion[0], 0);
  // 25 mm to the left of the colour camera, in B's axes.
  EXPECT_LT((cameras[1].X_BC.p - Vec3(0.002, 0.025, -0.001)).norm(), 1e-14);
  EXPECT_FALSE(stack::features::Registered(cameras[0], cameras[1]));
}

TEST(TumReader, AnotherCalibrationMayBeGiven) {
  const TemporaryFolder folder("tum_given"), elsewhere("tum_yaml");
  WriteSequence(folder.path());
  const fs::path yaml = elsewhere.path() / "mine.yaml";
  std::ofstream(yaml) << "width: 4\nheight: 3\nfx: 9\nfy: 9\ncx: 2\ncy: 1.5\n";
  const Recording recording = OpenRecording(folder.path(), yaml);
  EXPECT_EQ(recording.calibration.cameras[0].intrinsics.fx, 9);
  EXPECT_EQ(recording.depth->values_per_metre, 5000);                 // TUM's, where nothing is said
  EXPECT_NEAR(recording.calibration.cameras[0].rate.Hz(), 30, 1e-3);  // of the stamps
  fs::create_directories(elsewhere.path() / "mav0");
  EXPECT_NE(Complaint([&] { OpenRecording(elsewhere.path(), yaml); }).find("EuRoC ASL has a calibration of its own"),
            std::string::npos);
}

TEST(TumReader, TheWorldIsLevelledWhereGravityIsKnown) {
  const TemporaryFolder folder("tum_gravity");
  WriteSequence(folder.path());
  const Recording as_it_is = OpenRecording(folder.path());
  std::ofstream(folder.path() / "gravity-direction.txt") << "0.0\n0.8\n0.6\n";
  const Recording level = OpenRecording(folder.path());
  const base::Quat turn = level.truth[0].X_WB.q * as_it_is.truth[0].X_WB.q.conjugate();
  EXPECT_LT((turn * Vec3(0, 0.8, 0.6) - Vec3(0, 0, -1)).norm(), 1e-14);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT((level.truth[k].X_WB.p - turn * as_it_is.truth[k].X_WB.p).norm(), 1e-14);
  }
}

TEST(TumReader, SurvivesWhatIsMissing) {
  const TemporaryFolder folder("tum_gaps");
  WriteSequence(folder.path());
  fs::remove(folder.path() / "rgb" / "1.jpg");
  fs::remove(folder.path() / "depth" / "0.png");
  fs::remove(folder.path() / "groundtruth.txt");
  const Recording recording = OpenRecording(folder.path());
  EXPECT_EQ(recording.missing_images, 2);
  EXPECT_EQ(recording.images[0].size(), 2u);
  EXPECT_EQ(recording.depth->of_picture, (std::vector<std::optional<std::size_t>>{std::nullopt, 0}));
  EXPECT_TRUE(recording.truth.empty());
  fs::remove(folder.path() / "depth.txt");
  const Recording pictures = OpenRecording(folder.path());
  EXPECT_FALSE(pictures.depth);
  EXPECT_EQ(pictures.calibration.cameras.size(), 1u);
}

TEST(TumReader, BrokenFilesAreNamedWithTheirLine) {
  struct Bad {
    const char* file;
    const char* text;  // null: the file is taken away
    const char* message;
  };
  const std::vector<Bad> table = {
      {"rgb.txt", "1 rgb/a.png\n1 rgb/b.png\n", "rgb.txt:2: timestamp: is not later"},
      {"rgb.txt", "1 ../../secret.png\n", "rgb.txt:1: filename: must name a file in the dataset's folder"},
      {"rgb.txt", "1 /etc/passwd\n", "rgb.txt:1: filename: must name"},
      {"rgb.txt", "1\n", "rgb.txt:1: filename: is missing"},
      {"depth.txt", "x depth/a.png\n", "depth.txt:1: timestamp: `x`"},
      {"camera.yaml", nullptr, "camera.yaml: cannot be read; TUM's layout has no calibration"},
      {"camera.yaml", "width: 4\n", "camera.yaml"},
      {"camera.yaml", "width: 4\nheight: 3\nfx: -5\nfy: 6\ncx: 2\ncy: 1\n", "camera.yaml:3:5: fx"},
      {"camera.yaml", "width: 4\nheight: 3\nfx: 5\nfy: 6\ncx: 2\ncy: 1\ndistortion: [1, 2]\n",
       "distortion: must be [k1, k2, p1, p2]"},
      {"camera.yaml", "width: 4\nheight: 3\nfx: 5\nfy: 6\ncx: 2\ncy: 1\nfocal: 3\n", "focal"},
      {"rgb.yaml", "sensor_type: camera\n", "rgb.yaml"},
      {"gravity-direction.txt", "0 0 -2\n", "gravity-direction.txt: must hold"},
      {"gravity-direction.txt", "0 0\n0 -1\n", "gravity-direction.txt:2: gravity: has more than three"},
      {"gravity-direction.txt", "0 y -1\n", "gravity-direction.txt:1: gravity: `y`"},
      {"groundtruth.txt", "1 0 0 0 0 0 0 2\n", "groundtruth.txt:1: quaternion"},
      {"groundtruth.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "groundtruth.txt:2: timestamp"},
  };
  for (const Bad& bad : table) {
    const TemporaryFolder folder("tum_broken");
    WriteSequence(folder.path());
    fs::remove(folder.path() / bad.file);
    if (bad.text != nullptr) std::ofstream(folder.path() / bad.file) << bad.text;
    const std::string said = Complaint([&] { OpenRecording(folder.path()); });
    EXPECT_NE(said.find(bad.message), std::string::npos) << "wanted: " << bad.message << "\nsaid: " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

/// All pairings tried: what PairByStamp gives is that of the smallest differences, taken one after the other.
TEST(PairByStamp, ClosestFirst) {
  base::RandomStream random(7, "pairs");
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<ImageFile> a, b;
    for (int i = 0; i < 30; ++i) {
      a.push_back({base::Time{i * 33'000'000 + static_cast<std::int64_t>(random.Index(20'000'000))}, {}});
      if (random.Uniform() < 0.8) {
        b.push_back({base::Time{i * 33'000'000 + static_cast<std::int64_t>(random.Index(20'000'000))}, {}});
      }
    }
    const base::Duration limit = base::Milliseconds(15);
    std::vector<std::optional<std::size_t>> wanted(a.size());
    std::vector<bool> used(b.size());
    for (;;) {
      std::int64_t best = limit.ns + 1;
      std::size_t bi = 0, bj = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
          const std::int64_t off = std::abs((a[i].captured - b[j].captured).ns);
          if (!wanted[i] && !used[j] && off < best) best = off, bi = i, bj = j;
        }
      }
      if (best > limit.ns) break;
      wanted[bi] = bj;
      used[bj] = true;
    }
    EXPECT_EQ(PairByStamp(a, b, limit), wanted);
  }
  EXPECT_TRUE(PairByStamp({}, {}, base::Milliseconds(1)).empty());
}

}  // namespace
}  // namespace alula::scenarios::dataset
