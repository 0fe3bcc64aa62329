#include "stack/features/keypoint_depth.h"

#include <algorithm>
#include <cmath>

#include "stack/features/internal/stereo_matcher.h"

namespace alula::stack::features {

std::vector<std::optional<double>> KeypointDepths(const StereoRig& rig, const Image& left, const Image& right,
                                                  std::span<const base::Vec2> pixels,
                                                  const StereoTrackerConfig& config) {
  const Pyramid left_levels = BuildPyramid(left, rig.left.width, rig.left.height, true, config);
  const Pyramid right_levels = BuildPyramid(right, rig.right.width, rig.right.height, true, config);
  std::vector<StereoMatcher::Query> queries;
  for (const base::Vec2& pixel : pixels) queries.push_back({pixel, std::nullopt});
  std::vector<std::optional<double>> depths;
  for (const auto& match : StereoMatcher(rig, config).Find(left_levels, right_levels, queries)) {
    depths.push_back(match && match->depth > 0 ? std::optional(match->depth) : std::nullopt);
  }
  return depths;
}

std::optional<double> DepthAt(const DepthImage& depth, const base::Vec2& pixel) {
  constexpr std::size_t kLeast = 6;  // of nine
  constexpr double kSpread = 0.04;   // of the depth: what a slanted surface shows in three pixels, and a step does not
  const int u0 = static_cast<int>(std::lround(pixel.x())), v0 = static_cast<int>(std::lround(pixel.y()));
  std::vector<std::uint16_t> around;
  for (int v = std::max(0, v0 - 1); v <= std::min(depth.height - 1, v0 + 1); ++v) {
    for (int u = std::max(0, u0 - 1); u <= std::min(depth.width - 1, u0 + 1); ++u) {
      const std::uint16_t mm =
          (*depth.millimetres)[static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) +
                               static_cast<std::size_t>(u)];
      if (mm > 0) around.push_back(mm);
    }
  }
  if (around.size() < kLeast) return std::nullopt;
  std::sort(around.begin(), around.end());
  const double middle = around[around.size() / 2];
  if (around.back() - around.front() > kSpread * middle) return std::nullopt;
  return 1e-3 * middle;
}

std::vector<std::optional<double>> KeypointDepths(const StereoRig& rig, const Image& left, const Image& right,
                                                  const DepthImage& depth, std::span<const base::Vec2> pixels) {
  if (rig.depth == DepthSource::kStereo) return KeypointDepths(rig, left, right, pixels);
  std::vector<std::optional<double>> depths(pixels.size());
  if (rig.depth == DepthSource::kNone || !depth.millimetres) return depths;
  for (std::size_t i = 0; i < pixels.size(); ++i) depths[i] = DepthAt(depth, pixels[i]);
  return depths;
}

}  // namespace alula::stack::features
