#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "stack/slam/place_view.h"

namespace alula::stack::slam {

/// When two views are taken for the same place.
struct RelativePoseConfig {
  int max_distance = 64;          // bits between descriptors that match
  double ratio = 0.85;            // to the next best; look-alike corners of a room leave little below 0.8
  int trials = 300;               // of the sampling; stops when a better one is unlikely
  double pixel_sigma = 1.0;       // px of octave 0: a keypoint's place; with it what views from elsewhere change of it
  double disparity_sigma = 0.7;   // px: of the depths
  double gate = 3.0;              // σ beyond which a match is none
  double search_radius = 12.0;    // px around the predicted place, for more matches once the pose is known
  int search_distance = 80;       // bits there: the place vouches for them
  bool use_gravity = true;        // where both views know it: two points a sample, and it stays in the solution
  double gravity_sigma = 0.0175;  // rad (1°), of each view's knowledge of it
  int min_inliers = 40;     // what only looks alike (mats, walls of one stone) gives 29–37, places 41 and more (98 %)
  double min_share = 0.25;  // inliers among the points that should be seen in the other view
  double min_spread = 0.03;         // of the focal length: 1σ of the inliers' places across their narrow direction
  double max_position_sigma = 0.2;  // m
};

void Describe(base::Description& d, RelativePoseConfig& c);

/// A point of A is a point of B.
struct PointPair {
  int a = 0;
  int b = 0;
};

struct RelativePose {
  bool accepted = false;
  std::string reason;                          // where it is not
  base::Transform X_AB;                        // pose of camera B in camera A's frame
  base::Mat6 covariance = base::Mat6::Zero();  // of (δp_AB in A, m; δθ: R_AB Exp(δθ), rad)
  std::vector<PointPair> matches;              // by descriptors alone
  std::vector<PointPair> inliers;              // of the solution
  double spread = 0.0;                         // as min_spread
  double share = 0.0;                          // as min_share
};

/// The pose of one view in another by what both see, without any guess:
///   mutual matches → RANSAC (Fischler and Bolles 1981) over P3P, or two points and gravity, on the depths of A seen
///   from B and on those of B seen from A → Gauss–Newton → matches near predicted places → Gauss–Newton.
/// A residual is r = h(X p(m)) − m' with m = (u, v, disparity) where that is known, weighted by its whole covariance
/// S = D' + J D Jᵀ, so that far points, whose depth is vague, still turn the view; Huber at 1.5 σ. Depths at one end
/// are enough. The same input and seed give the same result.
RelativePose EstimateRelativePose(const PlaceView& a, const PlaceView& b, const RelativePoseConfig& config,
                                  std::uint64_t seed);

}  // namespace alula::stack::slam
