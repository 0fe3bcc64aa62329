#include "stack/features/keypoint_depth.h"

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

}  // namespace alula::stack::features
