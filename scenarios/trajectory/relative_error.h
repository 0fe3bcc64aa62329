#pragma once

#include <vector>

#include "scenarios/trajectory/error_statistics.h"
#include "scenarios/trajectory/pose_pairs.h"

namespace alula::scenarios::trajectory {

/// Relative pose error (Sturm et al. 2012) of pairs i → j: F = (T_i⁻¹ T_j)⁻¹ (E_i⁻¹ E_j), T true and E estimated poses;
/// no alignment is needed.
struct RelativeError {
  Statistics translation;  // |p of F|, m
  Statistics rotation;     // angle of F, deg
  Statistics percent;      // translation in percent of the true path from i to j; over path only
};

/// From every pair to the one nearest to `step` later, where that is off by less than a twentieth of the step.
RelativeError RelativeErrorOverTime(const std::vector<PosePair>& pairs, base::Duration step);

/// From every pair to the first one that is at least `length` (m, above 0) further along the true path. Where pairs are
/// far apart the way is longer than that, which `percent` allows for.
RelativeError RelativeErrorOverPath(const std::vector<PosePair>& pairs, double length);

/// Drift as KITTI's odometry benchmark counts it (Geiger et al. 2012): the mean over ways of 100, 200, … 800 m, from
/// every tenth pair on, of translation error / length and rotation error / length. A recording shorter than 100 m is
/// measured over 10, 20, … 80 m instead, one shorter than 10 m over 1, 2, … 8 m.
struct PathDrift {
  double unit = 0.0;      // m, the shortest way; 0: the path is shorter than 1 m and nothing was measured
  std::int64_t ways = 0;  // how many
  double percent = 0.0;   // of the way
  double degrees_per_metre = 0.0;
};
PathDrift PathDriftOf(const std::vector<PosePair>& pairs);

/// How far the last pose is off when the first one is right: |p of F| from the first pair to the last.
struct EndError {
  double metres = 0.0;
  double percent = 0.0;  // of the true path; infinite without any
};
EndError EndErrorOf(const std::vector<PosePair>& pairs);

}  // namespace alula::scenarios::trajectory
