#include "stack/mapping/stereo_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/stack/mapping/synthetic_scene.h"

namespace alula::stack::mapping {
namespace {

struct Errors {
  double bias = 0.0;   // median of measured minus true disparity, px at half size
  double sigma = 0.0;  // 1.4826 × median absolute deviation
  double gross = 0.0;  // share of valid pixels off by more than 1.5 px
  double valid = 0.0;  // share of pixels with depth
};

/// Renders the scene for both eyes from the origin, and compares the depth with the truth of the rectified camera.
Errors Measure(const test::Scene& scene, double misalignment, double noise, DepthMap* out = nullptr) {
  const Calibration calibration = test::StereoCalibration(misalignment);
  base::RandomStream random(21, "test/pixels");
  const auto& left = calibration.cameras[0];
  const auto& right = calibration.cameras[1];
  const Image a = scene.Picture(left.intrinsics, left.X_BC, noise, random);
  const Image b = scene.Picture(right.intrinsics, right.X_BC, noise, random);
  const DepthMap depth = StereoDepth(calibration, {}).Compute(a, b);
  const DepthMap truth = scene.Depth(depth, depth.X_BC);
  const double fb = depth.fx * depth.baseline;
  std::vector<double> errors;
  for (std::size_t n = 0; n < depth.z.size(); ++n) {
    if (depth.z[n] > 0 && std::isfinite(depth.z[n])) errors.push_back(fb / depth.z[n] - fb / truth.z[n]);
  }
  Errors result;
  result.valid = static_cast<double>(errors.size()) / static_cast<double>(depth.z.size());
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  result.bias = median(errors);
  std::vector<double> deviations;
  for (const double e : errors) {
    deviations.push_back(std::abs(e - result.bias));
    result.gross += std::abs(e) > 1.5 ? 1.0 / static_cast<double>(errors.size()) : 0.0;
  }
  result.sigma = 1.4826 * median(deviations);
  if (out != nullptr) *out = depth;
  std::printf("bias %.3f px, sigma %.3f px, gross %.4f, valid %.3f\n", result.bias, result.sigma, result.gross,
              result.valid);
  return result;
}

test::Scene SlantedWall(double distance, double slant) {
  test::Scene scene;
  scene.boxes.push_back({{base::FromYaw(slant), {distance, 0, 0}}, {0.05, 40, 40}});
  return scene;
}

// Bounds: the map is told 0.3 px at half size (OccupancyMapConfig::disparity_sigma), 0.1 px of it common.
TEST(StereoDepth, SlantedTexturedPlanesAreMeasured) {
  for (const double distance : {1.0, 2.0, 4.0}) {
    const Errors e = Measure(SlantedWall(distance, 0.4), 0.0, 2.0);
    EXPECT_LT(std::abs(e.bias), 0.1) << distance;
    EXPECT_LT(e.sigma, 0.3) << distance;
    EXPECT_LT(e.gross, 0.01) << distance;
    EXPECT_GT(e.valid, 0.85) << distance;
  }
}

TEST(StereoDepth, ATurnedEyeIsRectified) {
  const Errors e = Measure(SlantedWall(2.0, 0.3), 1.5 * M_PI / 180, 2.0);
  EXPECT_LT(std::abs(e.bias), 0.1);
  EXPECT_LT(e.sigma, 0.3);
  EXPECT_GT(e.valid, 0.8);
}

TEST(StereoDepth, AFrameBeforeAWallKeepsItsBarsAndFewPixelsFly) {
  test::Scene scene = SlantedWall(6.0, 0.0);
  scene.AddGate({base::Quat::Identity(), {3.0, 0.1, 0.0}}, 1.4, 0.15, 0.15);
  DepthMap depth;
  const Errors e = Measure(scene, 0.0, 2.0, &depth);
  EXPECT_LT(std::abs(e.bias), 0.1);
  EXPECT_LT(e.gross, 0.03);
  int flying = 0;
  int on_bars = 0;
  for (const float z : depth.z) {
    flying += z > 3.5F && z < 5.0F ? 1 : 0;
    on_bars += z > 2.6F && z < 3.4F ? 1 : 0;
  }
  // 0.15 m at 3 m are 9.5 px; four bars of about 1.55 m: 3700 px.
  EXPECT_GT(on_bars, 2500);
  EXPECT_LT(flying, 250);
}

TEST(StereoDepth, APlainSkyAndPlainWallsStayUnknown) {
  test::Scene scene;
  scene.AddBox({0, 0, -1.5}, {40, 40, 0.2});
  DepthMap depth;
  Measure(scene, 0.0, 2.0, &depth);
  int known = 0;
  for (int v = 0; v < 90; ++v) {
    for (int u = 0; u < depth.width; ++u) known += depth.At(u, v) > 0 ? 1 : 0;
  }
  EXPECT_LT(known, 90 * 320 / 200);
}

TEST(StereoDepth, RefusesWhatIsNoPair) {
  Calibration calibration = test::StereoCalibration(0.0);
  const StereoDepth stereo(calibration, {});
  EXPECT_THROW(stereo.Compute({}, {}), base::InputError);
  std::swap((*calibration.stereo)[0], (*calibration.stereo)[1]);
  EXPECT_THROW(StereoDepth(calibration, {}), base::InputError);
  calibration.stereo.reset();
  EXPECT_THROW(StereoDepth(calibration, {}), base::InputError);
}

}  // namespace
}  // namespace alula::stack::mapping
