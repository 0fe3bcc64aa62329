#pragma once

#include <optional>
#include <vector>

#include "base/frames.h"

namespace alula::stack::slam {

/// Where the eyes sit on the body.
struct Eyes {
  base::Transform X_BL;                 // left camera on the body
  std::optional<base::Transform> X_LR;  // right camera in the left one's frame, where there is one
};

/// A point seen by a keyframe, normalised coordinates (x/z, y/z). The right eye adds one row only, along the epipolar
/// line: across it the match has told nothing new.
struct Sight {
  int pose = 0;
  base::Vec2 left = base::Vec2::Zero();
  std::optional<base::Vec2> right;
  double sigma = 1.0;  // of a coordinate, normalised
};

/// A point with all its sights; a fixed one pulls at poses and stays where it is.
struct BundlePoint {
  base::Vec3 p_M = base::Vec3::Zero();
  std::vector<Sight> sights;
  bool fixed = false;
};

struct BundlePose {
  base::Transform X_MB;
  bool fixed = false;
};

/// Motion between two keyframes as the odometry measured it: X_FT with 1σ of its position (m, axes of F) and attitude
/// (rad, axes of T).
struct RelativeMotion {
  int from = 0, to = 0;
  base::Transform X_FT;
  base::Vec6 sigma = base::Vec6::Ones();
};

/// The vertical as the odometry sees it: `up_B` is the world's z axis in the body, 1σ in rad.
struct Vertical {
  int pose = 0;
  base::Vec3 up_B = base::Vec3::UnitZ();
  double sigma = 0.005;
};

/// Poses of keyframes and points of a map, and all that ties them together.
struct Bundle {
  Eyes eyes;
  std::vector<BundlePose> poses;
  std::vector<BundlePoint> points;
  std::vector<RelativeMotion> motions;
  std::vector<Vertical> verticals;
};

struct BundleOptions {
  int iterations = 5;       // of Levenberg–Marquardt
  double huber = 2.0;       // σ beyond which a sight's pull grows no more
  double tolerance = 1e-4;  // share of the cost; a smaller step of it ends the work
};

struct BundleSummary {
  double initial_cost = 0.0, cost = 0.0;  // ½ Σ ρ(|r|²)
  int iterations = 0;                     // accepted steps
};

/// Least squares over all poses and points that are not fixed (Triggs et al. 2000), points eliminated (Schur
/// complement); the reduced system is solved densely while it is small, sparsely beyond. At least one pose must be
/// fixed, or held by the others. Points that no eye can see from where they stand add nothing. One thread; the same
/// input gives the same bits.
BundleSummary Adjust(Bundle& bundle, const BundleOptions& options);

/// The sight's residual in σ: (left x, left y, along the epipolar line of the right eye or 0). None behind an eye.
std::optional<base::Vec3> ResidualOf(const base::Transform& X_MB, const Eyes& eyes, const Sight& sight,
                                     const base::Vec3& p_M);

}  // namespace alula::stack::slam
