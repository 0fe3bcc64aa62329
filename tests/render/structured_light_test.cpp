// Structured-light depth against closed forms.
#include "render/structured_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace alula::render {
namespace {

constexpr double kFocal = 525.0;

DepthPicture Flat(double z, int width = 320, int height = 240) {
  return {width, height, std::vector<float>(static_cast<std::size_t>(width * height), static_cast<float>(z))};
}

StructuredLight Perfect() {
  StructuredLight sensor;
  sensor.disparity_noise = 0;
  sensor.disparity_step = 1e-4;
  sensor.holes = 0;
  sensor.farthest = 10;
  return sensor;
}

std::vector<std::uint16_t> Measure(const DepthPicture& depth, const StructuredLight& sensor, std::uint64_t key = 1) {
  return MeasureDepth(depth, kFocal, nullptr, nullptr, sensor, key);
}

TEST(StructuredLight, WithoutFaultsMeasuresTheDepth) {
  for (const double z : {0.5, 1.234, 4.2}) {
    for (const std::uint16_t mm : Measure(Flat(z), Perfect())) EXPECT_NEAR(mm, 1000 * z, 1.0);
  }
}

TEST(StructuredLight, StepsOfDisparityAreStepsOfDepth) {
  StructuredLight sensor = Perfect();
  sensor.disparity_step = 0.125;
  std::set<std::uint16_t> seen;
  for (double z = 3.0; z < 3.3; z += 0.001) seen.insert(Measure(Flat(z, 2, 2), sensor)[0]);
  // f b / z runs from 13.125 px, which is a step, to 11.94.
  const auto steps = [&](double z) { return std::round(kFocal * sensor.baseline / z / 0.125); };
  EXPECT_EQ(static_cast<double>(seen.size()), steps(3.0) - steps(3.299) + 1);
}

TEST(StructuredLight, NoiseGrowsWithTheSquareOfTheRange) {
  StructuredLight sensor = Perfect();
  sensor.disparity_noise = 0.1;
  sensor.disparity_step = 0.125;
  for (const double z : {1.0, 2.0, 3.0}) {
    double sum = 0, squares = 0;
    int count = 0;
    for (std::uint64_t key = 1; key <= 20; ++key) {
      for (const std::uint16_t mm : Measure(Flat(z), sensor, key)) {
        sum += mm;
        squares += static_cast<double>(mm) * mm;
        ++count;
      }
    }
    const double mean = sum / count;
    const double sigma = std::sqrt(squares / count - mean * mean);
    const double expected = 1000 * z * z / (kFocal * sensor.baseline) * std::sqrt(0.1 * 0.1 + 0.125 * 0.125 / 12);
    // Rounding's share is that of a uniform error only on the average over z: at one z it differs by some percent.
    EXPECT_NEAR(sigma, expected, 0.08 * expected) << z;
    EXPECT_NEAR(mean, 1000 * z, 0.1 * expected + 0.5) << z;
  }
}

TEST(StructuredLight, NeighboursShareTheirNoise) {
  StructuredLight sensor = Perfect();
  sensor.disparity_noise = 0.1;
  const auto mm = Measure(Flat(2.0), sensor);
  double same = 0, next = 0, far = 0;
  for (std::size_t i = 0; i + 40 < mm.size(); ++i) {
    same += (mm[i] - 2000.0) * (mm[i] - 2000.0);
    next += (mm[i] - 2000.0) * (mm[i + 1] - 2000.0);
    far += (mm[i] - 2000.0) * (mm[i + 40] - 2000.0);
  }
  EXPECT_GT(next / same, 0.7);
  EXPECT_LT(std::abs(far / same), 0.1);
}

/// A near thing in the middle: on its right the projector's shadow, f b (1/z1 − 1/z2) px wide.
TEST(StructuredLight, LosesWhatTheProjectorCannotSee) {
  DepthPicture depth = Flat(2.0);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 100; u < 150; ++u) depth.metres[static_cast<std::size_t>(v * 320 + u)] = 0.8F;
  }
  const auto mm = Measure(depth, Perfect());
  const std::size_t row = 120 * 320;
  int lost_right = 0, lost_left = 0;
  for (std::size_t u = 150; u < 320; ++u) lost_right += mm[row + u] == 0;
  for (std::size_t u = 0; u < 100; ++u) lost_left += mm[row + u] == 0;
  EXPECT_NEAR(lost_right, kFocal * 0.075 * (1 / 0.8 - 1 / 2.0), 1.0);
  EXPECT_EQ(lost_left, 1);  // the edge's own pixel
}

TEST(StructuredLight, LosesGrazingSurfacesRangesGlassAndGlare) {
  DepthPicture slanted = Flat(1.0);
  for (int u = 0; u < 320; ++u) {
    for (int v = 0; v < 240; ++v)
      slanted.metres[static_cast<std::size_t>(v * 320 + u)] = 1.0F + 0.004F * static_cast<float>(u);
  }
  // At 1.4 m the tangent is 0.004 · 525 / 1.4 = 1.5: 56°.
  StructuredLight sensor = Perfect();
  sensor.grazing = 0.9;  // 51.6°: tangent 1.26, reached at 1.67 m
  const auto mm = Measure(slanted, sensor);
  EXPECT_EQ(mm[120 * 320 + 100], 0);
  EXPECT_NE(mm[120 * 320 + 180], 0);
  sensor.grazing = 1.2;
  EXPECT_NE(Measure(slanted, sensor)[120 * 320 + 100], 0);

  EXPECT_EQ(Measure(Flat(0.29), Perfect())[5], 0);
  EXPECT_EQ(Measure(Flat(10.1), Perfect())[5], 0);
  EXPECT_EQ(Measure(Flat(0.0), Perfect())[5], 0);

  std::vector<std::uint8_t> glass(320 * 240, 0);
  glass[7] = 1;
  Picture ambient{320, 240, 1, std::vector<std::uint8_t>(320 * 240, 100)};
  ambient.bytes[9] = 255;
  const auto spoiled = MeasureDepth(Flat(1.0), kFocal, &ambient, &glass, Perfect(), 1);
  EXPECT_NE(spoiled[6], 0);
  EXPECT_EQ(spoiled[7], 0);
  EXPECT_EQ(spoiled[9], 0);
}

TEST(StructuredLight, HolesAreAsManyAsStated) {
  StructuredLight sensor = Perfect();
  sensor.holes = 0.05;
  const auto mm = Measure(Flat(1.0), sensor);
  const double share = static_cast<double>(std::count(mm.begin(), mm.end(), 0)) / static_cast<double>(mm.size());
  EXPECT_NEAR(share, 0.05, 4 * std::sqrt(0.05 * 0.95 / (160 * 120)));  // spots of 2×2 px
}

/// A plane square to the axis, seen from a camera that stands 25 mm beside: moved by f · 0.025 / z px.
TEST(StructuredLight, RegistersToAnotherCamera) {
  const stack::CameraIntrinsics depth{320, 240, kFocal, kFocal, 159.5, 119.5, {}};
  const stack::CameraIntrinsics other{640, 480, 2 * kFocal, 2 * kFocal, 319.5, 239.5, {}};
  std::vector<std::uint16_t> mm(320 * 240, 2000);
  for (std::size_t v = 0; v < 240; ++v) {
    for (std::size_t u = 100; u < 140; ++u) mm[v * 320 + u] = 1000;
  }
  const auto out = RegisterDepth(mm, depth, other, {base::Quat::Identity(), {0.025, 0, 0.01}});
  const std::size_t row = 240 * 640;
  std::size_t first = 0, last = 0;
  for (std::size_t u = 0; u < 640; ++u) {
    if (out[row + u] != 1010) continue;
    if (first == 0) first = u;
    last = u;
  }
  const double left = 1050.0 * ((99.5 - 159.5) / kFocal * 1.0 + 0.025) / 1.01 + 319.5;
  const double right = 1050.0 * ((139.5 - 159.5) / kFocal * 1.0 + 0.025) / 1.01 + 319.5;
  EXPECT_NEAR(static_cast<double>(first), left, 1.0);
  EXPECT_NEAR(static_cast<double>(last), right, 1.0);
  EXPECT_EQ(out[row + 500], 2010);
  int holes = 0;  // none in the middle of a surface, for all that the other camera is finer
  for (std::size_t u = first; u <= last; ++u) holes += out[row + u] == 0;
  EXPECT_EQ(holes, 0);
}

}  // namespace
}  // namespace alula::render
