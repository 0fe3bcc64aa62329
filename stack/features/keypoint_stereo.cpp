#include "stack/features/keypoint_stereo.h"

#include "stack/features/internal/pyramid.h"
#include "stack/features/internal/stereo_matcher.h"

namespace alula::stack::features {

std::vector<std::optional<StereoSight>> FindInRightEye(const Image& left, const Image& right,
                                                       std::span<const base::Vec2> pixels, const StereoRig& rig,
                                                       const StereoTrackerConfig& config) {
  const Pyramid a = BuildPyramid(left, rig.left.width, rig.left.height, true, config);
  const Pyramid b = BuildPyramid(right, rig.right.width, rig.right.height, true, config);
  std::vector<StereoMatcher::Query> queries;
  for (const base::Vec2& pixel : pixels) queries.push_back({pixel, std::nullopt});
  std::vector<std::optional<StereoSight>> sights;
  for (const auto& match : StereoMatcher(rig, config).Find(a, b, queries)) {
    sights.push_back(match ? std::optional(StereoSight{match->right, match->depth}) : std::nullopt);
  }
  return sights;
}

}  // namespace alula::stack::features
