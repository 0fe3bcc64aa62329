#include "worlds/textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "worlds/texture_canvas.h"

namespace alula::worlds {
namespace {

const Palette kGreys{{0.1F, 0.1F, 0.1F}, {0.9F, 0.9F, 0.9F}};
const std::vector<Pattern> kAll{Pattern::kBrick,   Pattern::kPlaster, Pattern::kConcrete, Pattern::kRubble,
                                Pattern::kPaving,  Pattern::kGravel,  Pattern::kWood,     Pattern::kBark,
                                Pattern::kFoliage, Pattern::kSignal,  Pattern::kPad};

std::vector<double> Grey(const geometry::Texture& texture) {
  std::vector<double> grey;
  for (std::size_t i = 0; i < texture.rgb.size(); i += 3) {
    grey.push_back((texture.rgb[i] + texture.rgb[i + 1] + texture.rgb[i + 2]) / 3.0);
  }
  return grey;
}

double Deviation(const std::vector<double>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
}

std::vector<double> Halved(const std::vector<double>& in, std::size_t size) {
  std::vector<double> out;
  for (std::size_t y = 0; y < size; y += 2) {
    for (std::size_t x = 0; x < size; x += 2) {
      out.push_back(0.25 *
                    (in[y * size + x] + in[y * size + x + 1] + in[(y + 1) * size + x] + in[(y + 1) * size + x + 1]));
    }
  }
  return out;
}

/// From near (one texel a pixel) to far (32 texels a pixel) enough contrast is left for corners: pixel noise is ~2.
TEST(Textures, HaveContrastAtEveryScale) {
  constexpr std::size_t kSize = 512;
  for (const Pattern pattern : kAll) {
    SCOPED_TRACE(static_cast<int>(pattern));
    std::vector<double> grey = Grey(*MakeTexture(pattern, kGreys, kSize, 1, "test"));
    EXPECT_GT(Deviation(grey), 30.0);
    for (std::size_t size = kSize; size > kSize / 32; size /= 2) {
      const std::vector<double> coarse = Halved(grey, size);
      std::vector<double> detail;
      for (std::size_t i = 0; i < grey.size(); ++i) {
        detail.push_back(grey[i] - coarse[(i / size / 2) * (size / 2) + (i % size) / 2]);
      }
      EXPECT_GT(Deviation(detail), 5.0) << size;
      grey = coarse;
    }
  }
}

TEST(Textures, DependOnSeedAndNameOnly) {
  const auto a = MakeTexture(Pattern::kPlaster, kGreys, 64, 1, "a");
  EXPECT_EQ(a->rgb, MakeTexture(Pattern::kPlaster, kGreys, 64, 1, "a")->rgb);
  EXPECT_NE(a->rgb, MakeTexture(Pattern::kPlaster, kGreys, 64, 2, "a")->rgb);
  EXPECT_NE(a->rgb, MakeTexture(Pattern::kPlaster, kGreys, 64, 1, "b")->rgb);
}

TEST(Textures, SizesAreChecked) {
  EXPECT_THROW(MakeTexture(Pattern::kBrick, kGreys, 100, 1, "a"), base::InputError);
  EXPECT_THROW(MakeTexture(Pattern::kBrick, kGreys, 8, 1, "a"), base::InputError);
}

/// Half of each texture against the other half: a pattern with a period of half the texture would give one.
TEST(Textures, DoNotRepeatInside) {
  for (const Pattern pattern : kAll) {
    if (pattern == Pattern::kPad) continue;  // rings about its middle
    SCOPED_TRACE(static_cast<int>(pattern));
    const std::vector<double> grey = Grey(*MakeTexture(pattern, kGreys, 256, 1, "test"));
    const double deviation = Deviation(grey);
    double mean = 0.0;
    for (const double g : grey) mean += g / static_cast<double>(grey.size());
    double product = 0.0;
    for (std::size_t i = 0; i < grey.size(); ++i) {
      const std::size_t y = i / 256;
      const std::size_t x = i % 256;
      product += (grey[i] - mean) * (grey[y * 256 + (x + 128) % 256] - mean);
    }
    EXPECT_LT(std::abs(product / static_cast<double>(grey.size())), 0.3 * deviation * deviation);
  }
}

TEST(Cells, NearestPointIsFoundAcrossTheSeam) {
  base::RandomStream random(1, "cells");
  const Cells cells = MakeCells(64, 4, 4, 0.9, random);
  std::vector<int> count(16, 0);
  for (const std::uint32_t id : cells.id) ++count[id];
  for (const int c : count) EXPECT_GT(c, 40);  // 256 on average
  for (const float e : cells.edge) EXPECT_GE(e, 0.0F);
}

}  // namespace
}  // namespace alula::worlds
