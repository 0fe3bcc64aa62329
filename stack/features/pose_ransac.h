#pragma once

#include <vector>

#include "base/frames.h"
#include "base/random.h"
#include "stack/features/pose_solvers.h"

namespace alula::stack::features {

struct PoseResult {
  base::Transform X_TS;  // points from their frame S to that of the camera, T
  std::vector<bool> inlier;
  int inliers = 0;
};

/// RANSAC (Fischler and Bolles 1981) over three points a sample for the pose of a camera that sees known points, then
/// Gauss-Newton over all that agree (reprojection, Huber's kernel at the gate's third). `gate`: in normalised units.
/// `guess` is tried first, so that a good prediction is never worse than chance. Deterministic for a given stream.
PoseResult FindPose(const std::vector<PointAndRay>& points, const base::Transform& guess, double gate, int trials,
                    base::RandomStream& random);

}  // namespace alula::stack::features
