#include "render/sensor_effects.h"

#include <gtest/gtest.h>

#include <cmath>

namespace alula::render {
namespace {

Picture Flat(std::uint8_t value) { return {640, 480, 1, std::vector<std::uint8_t>(640UL * 480, value)}; }

struct Moments {
  double mean = 0, variance = 0, skewness = 0, kurtosis = 0, neighbour = 0;
};

Moments MomentsOf(const Picture& picture) {
  Moments m;
  const auto n = static_cast<double>(picture.bytes.size());
  for (const std::uint8_t b : picture.bytes) m.mean += b / n;
  double last = 0;
  for (const std::uint8_t b : picture.bytes) {
    const double d = b - m.mean;
    m.variance += d * d / n;
    m.skewness += d * d * d / n;
    m.kurtosis += d * d * d * d / n;
    m.neighbour += d * last / n;
    last = d;
  }
  m.skewness /= std::pow(m.variance, 1.5);
  m.kurtosis /= m.variance * m.variance;
  m.neighbour /= m.variance;
  return m;
}

// Bounds are about five standard errors of 307,200 samples: σ/554 for the mean, 0.26 % for the variance.
TEST(PixelNoise, HasTheMomentsItClaims) {
  for (const int value : {40, 128, 210}) {
    for (const PixelNoise noise : {PixelNoise{0.8, 0.012}, PixelNoise{3.0, 0.0}, PixelNoise{0.5, 0.1}}) {
      Picture picture = Flat(static_cast<std::uint8_t>(value));
      ApplyPixelNoise(picture, 99, noise);
      const Moments m = MomentsOf(picture);
      const double variance = noise.read_sigma * noise.read_sigma + noise.shot * value;
      EXPECT_NEAR(m.mean, value, 5.0 * std::sqrt(variance) / 554.0);
      EXPECT_NEAR(m.variance / variance, 1.0, 0.02);
      EXPECT_NEAR(m.skewness, 0.0, 0.025);
      EXPECT_NEAR(m.kurtosis, 2.72, 0.12);  // 3 − 6/5/4 of a sum of four uniforms, a little more by rounding
      EXPECT_NEAR(m.neighbour, 0.0, 0.01);
    }
  }
}

TEST(PixelNoise, IsAFunctionOfItsKeyAlone) {
  Picture a = Flat(100);
  Picture b = Flat(100);
  Picture other = Flat(100);
  ApplyPixelNoise(a, 5, {});
  ApplyPixelNoise(b, 5, {});
  ApplyPixelNoise(other, 6, {});
  EXPECT_TRUE(a.bytes == b.bytes);
  double product = 0;
  double square = 0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) {
    product += (a.bytes[i] - 100.0) * (other.bytes[i] - 100.0);
    square += (a.bytes[i] - 100.0) * (a.bytes[i] - 100.0);
  }
  EXPECT_LT(std::abs(product / square), 0.01);
}

TEST(PixelNoise, NoneIsNone) {
  Picture picture = Flat(77);
  ApplyPixelNoise(picture, 5, {0.0, 0.0});
  EXPECT_TRUE(picture.bytes == Flat(77).bytes);
}

TEST(PixelNoise, StaysInRangeAtBothEnds) {
  Picture dark = Flat(0);
  Picture bright = Flat(255);
  ApplyPixelNoise(dark, 1, {4.0, 0.1});
  ApplyPixelNoise(bright, 1, {4.0, 0.1});
  EXPECT_LT(MomentsOf(dark).mean, 4.0);
  EXPECT_GT(MomentsOf(bright).mean, 245.0);
}

}  // namespace
}  // namespace alula::render
