// `alula export --format tum`: depth, stamps, intrinsics and poses of the files belong together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/text_rows.h"
#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/layouts.h"
#include "scenarios/dataset/png.h"
#include "scenarios/dataset/sensor_yaml.h"
#include "stack/interface/camera_model.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::dataset {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::Alula;
using scenarios::testing::CommandResult;
using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;

struct DepthFrame {
  base::Time time;
  PngImage map;
  base::Transform X_WC;

  /// Metres; 0 where nothing was measured.
  double At(int u, int v) const {
    const auto* values = reinterpret_cast<const std::uint16_t*>(map.bytes.data());
    return values[static_cast<std::size_t>(v * map.width + u)] / 5000.0;
  }
};

/// Depth frames with the pose of the same stamp.
std::vector<DepthFrame> ReadFrames(const fs::path& folder) {
  std::vector<DepthFrame> frames;
  base::ForEachRowOf(folder / "depth.txt", [&](const base::TextRow& row) {
    frames.push_back({row.TimeInSeconds(0, "t"), ReadPng(folder / row.Word(1, "file")), {}});
  });
  std::size_t posed = 0;
  base::ForEachRowOf(folder / "groundtruth.txt", [&](const base::TextRow& row) {
    for (DepthFrame& frame : frames) {
      if (row.TimeInSeconds(0, "t") != frame.time) continue;
      frame.X_WC = {{row.Number(7, "w"), row.Number(4, "x"), row.Number(5, "y"), row.Number(6, "z")},
                    {row.Number(1, "x"), row.Number(2, "y"), row.Number(3, "z")}};
      ++posed;
    }
  });
  EXPECT_EQ(posed, frames.size());
  return frames;
}

/// Median of |depth seen − depth foretold from an earlier frame|, over frames one second apart; m.
double MedianDisagreement(const std::vector<DepthFrame>& frames, const stack::CameraIntrinsics& camera,
                          std::size_t& compared) {
  std::vector<double> errors;
  for (std::size_t i = 0; i + 5 < frames.size(); ++i) {
    const DepthFrame &a = frames[i], &b = frames[i + 5];
    for (int v = 8; v < camera.height; v += 8) {
      for (int u = 8; u < camera.width; u += 8) {
        const double depth = a.At(u, v);
        if (depth == 0) continue;
        const base::Vec2 xy = stack::Normalise(camera, base::Vec2(u, v));
        const base::Vec3 p = b.X_WC.Inverse() * (a.X_WC * base::Vec3(depth * xy.x(), depth * xy.y(), depth));
        if (p.z() < 0.1) continue;
        const base::Vec2 pixel = stack::Project(camera, p);
        if (!stack::Inside(camera, pixel, 2)) continue;
        const double seen = b.At(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
        if (seen > 0) errors.push_back(std::abs(seen - p.z()));
      }
    }
  }
  compared = errors.size();
  if (errors.empty()) return 0;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

base::Transform TruePoseAt(const Recording& recording, base::Time time) {
  for (const BodyTruth& truth : recording.truth) {
    if (truth.time == time) return truth.X_WB;
  }
  ADD_FAILURE() << "no truth at " << time.Seconds();
  return {};
}

TEST(TumExport, DepthAndPosesAgree) {
  const TemporaryFolder folder("tum_export");
  // Above the ground, looking half down, while it turns; with finer light than a real one's, which tells less.
  const CommandResult run =
      Alula({"export", "prescribed_flight", "--quiet", "--format", "tum", "--out", folder.path() / "d", "--set",
             "vehicle.motion.waypoints=[[-9 m, -5 m, 3.7 m], [-5.5 m, -5.2 m, 3.3 m], [-4.5 m, -2 m, 3.5 m]]", "--set",
             "vehicle.standstill=0.2 s", "--set", "sensors.stereo=~", "--set",
             "sensors.rgbd=[{name: front, rate: 5 Hz, pitch: 50 deg, depth: {light: {farthest: 8 m, blinding: 1, "
             "disparity_noise: 0.02 px, disparity_step: 0.01 px}}}]"});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  std::vector<DepthFrame> frames = ReadFrames(folder.path() / "d");
  const stack::CameraCalibration camera = ReadCameraYaml(ReadText(folder.path() / "d" / "depth.yaml"), "depth.yaml");
  std::size_t rgb = 0;
  base::ForEachRowOf(folder.path() / "d" / "rgb.txt", [&](const base::TextRow& row) {
    const PngImage image = ReadPng(folder.path() / "d" / row.Word(1, "file"));
    EXPECT_EQ(image.channels, 3);
    EXPECT_EQ(row.TimeInSeconds(0, "t"), frames.at(rgb).time);  // the pair is triggered together
    ++rgb;
  });
  EXPECT_GE(frames.size(), 20u);

  // The export opens as a recording, with a depth image for each picture.
  const Recording recording = OpenRecording(folder.path() / "d");
  EXPECT_EQ(recording.layout, Layout::kTum);
  ASSERT_TRUE(recording.depth);
  EXPECT_EQ(recording.images[0].size(), rgb);
  for (std::size_t k = 0; k < rgb; ++k) EXPECT_EQ(recording.depth->of_picture[k], k);
  EXPECT_EQ(LoadImage(recording.images[0][0], recording.calibration.cameras[0]).format, stack::PixelFormat::kRgb8);
  const base::Transform X_WC = TruePoseAt(recording, frames[3].time) * recording.calibration.cameras[0].X_BC;
  EXPECT_LT((X_WC.p - frames[3].X_WC.p).norm(), 1e-12);

  // Depth is known to z² σ_d / (f b): 8 mm at 4 m with 0.02 px; taking the nearest pixel adds half a pixel of slanted
  // ground, 4 mm.
  constexpr double kBound = 0.015;  // m
  std::size_t compared = 0;
  const double right = MedianDisagreement(frames, camera.intrinsics, compared);
  std::printf("depth foretold and seen one second later: median %.1f mm apart (%zu pixels)\n", 1e3 * right, compared);
  EXPECT_GT(compared, 10'000u);
  EXPECT_LT(right, kBound);
  // A scale of 4000 a metre is seen.
  std::vector<DepthFrame> scaled = frames;
  for (DepthFrame& frame : scaled) {
    auto* values = reinterpret_cast<std::uint16_t*>(frame.map.bytes.data());
    for (std::size_t i = 0; i < frame.map.bytes.size() / 2; ++i)
      values[i] = static_cast<std::uint16_t>(values[i] * 5 / 4);
  }
  const double wrong = MedianDisagreement(scaled, camera.intrinsics, compared);
  std::printf("with 4000 a metre: %.1f mm\n", 1e3 * wrong);
  EXPECT_GT(wrong, kBound);
}

}  // namespace
}  // namespace alula::scenarios::dataset
