#include "stack/features/internal/level_corners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "stack/features/internal/orb_kernels.h"

namespace alula::stack::features::internal {
namespace {

/// P1's saliency: contrast of a pixel to the 16 of its circle.
float Saliency(const Octave& image, int x, int y) {
  const int centre = image.Row(y)[x];
  int sum = 0;
  for (const auto& [u, v] : kCircle) sum += std::abs(centre - image.Row(y + v)[x + u]);
  return static_cast<float>(sum);
}

/// Where the parabola through three scores, the middle one the largest, has its top, px from the middle.
float Vertex(int before, int middle, int after) {
  const int curvature = 2 * middle - before - after;
  return curvature > 0 ? 0.5F * static_cast<float>(after - before) / static_cast<float>(curvature) : 0.0F;
}

/// Local maxima of the score inside the border.
std::vector<LevelCorner> FindPeaks(const Octave& level, int threshold, Octave& scores) {
  const OrbKernels& kernels = ChooseOrbKernels();
  const int width = level.width - 2 * kOrbBorder, last = level.height - kOrbBorder;
  // Scores of one pixel more on each side, so that a peak at the border has all its neighbours.
  for (int y = kOrbBorder - 1; y <= last; ++y) {
    kernels.corner_scores(level.Row(y) + kOrbBorder - 1, level.stride, width + 2, threshold,
                          scores.Row(y) + kOrbBorder - 1);
  }
  std::vector<LevelCorner> corners;
  std::vector<std::uint32_t> peaks(static_cast<std::size_t>(width / 32 + 1));
  for (int y = kOrbBorder; y < last; ++y) {
    const std::uint8_t* row = scores.Row(y) + kOrbBorder;
    kernels.peaks(row, scores.stride, width, peaks.data());
    for (int word = 0; 32 * word < width; ++word) {
      for (std::uint32_t bits = peaks[static_cast<std::size_t>(word)]; bits != 0; bits &= bits - 1) {
        const int x = 32 * word + std::countr_zero(bits);
        const std::uint8_t* s = row + x;
        corners.push_back({x + kOrbBorder, y, static_cast<float>(*s), Vertex(s[-1], *s, s[1]),
                           Vertex(s[-scores.stride], *s, s[scores.stride])});
      }
    }
  }
  return corners;
}

}  // namespace

std::vector<LevelCorner> FindLevelCorners(const Octave& level, const OrbConfig& config, Octave& scratch) {
  std::vector<LevelCorner> corners = FindPeaks(level, std::min(config.low_threshold, config.threshold), scratch);
  const int columns = level.width / config.cell + 1;
  const auto cell_of = [&](const LevelCorner& c) {
    return static_cast<std::size_t>(c.y / config.cell * columns + c.x / config.cell);
  };
  std::vector<bool> strong(static_cast<std::size_t>(columns * (level.height / config.cell + 1)), false);
  const auto limit = static_cast<float>(config.threshold);
  for (const LevelCorner& c : corners) {
    if (c.response > limit) strong[cell_of(c)] = true;
  }
  std::erase_if(corners, [&](const LevelCorner& c) { return c.response <= limit && strong[cell_of(c)]; });
  if (config.ranking == OrbRanking::kSaliency) {
    for (LevelCorner& c : corners) c.response = Saliency(level, c.x, c.y);
  }
  return corners;
}

}  // namespace alula::stack::features::internal
