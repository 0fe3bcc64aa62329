#pragma once

#include <optional>
#include <vector>

#include "stack/features/internal/pyramid.h"
#include "stack/features/stereo_rig.h"

namespace alula::stack::features {

/// Finds points of the left image in the right one of the same instant.
class StereoMatcher {
 public:
  StereoMatcher(const StereoRig& rig, const StereoTrackerConfig& config);

  /// A point to be matched: its left pixel, and its depth (m) where it is roughly known.
  struct Query {
    base::Vec2 pixel;
    std::optional<double> depth;
  };
  struct Match {
    base::Vec2 pixel;        // right image
    base::Vec2 left, right;  // normalised
    double depth = 0.0;      // m, negative where the rays diverge
  };

  /// One answer a query. Points of known depth are followed from their expected place; the others are searched for
  /// along the epipolar line at half resolution first. Matches off the epipolar line are refused.
  std::vector<std::optional<Match>> Find(const Pyramid& left, const Pyramid& right,
                                         const std::vector<Query>& queries) const;

 private:
  std::optional<base::Vec2> SearchEpipolarLine(const Pyramid& left, const Pyramid& right,
                                               const base::Vec2& pixel) const;
  std::optional<Match> Accept(const base::Vec2& left_pixel, const cv::Point2f& right_pixel) const;

  StereoRig rig_;
  StereoTrackerConfig config_;
  base::Transform X_RL_;
};

}  // namespace alula::stack::features
