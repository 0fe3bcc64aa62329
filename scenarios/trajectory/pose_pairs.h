#pragma once

#include <optional>
#include <vector>

#include "base/trajectory_file.h"

namespace alula::scenarios::trajectory {

/// An estimated pose and the true one of the same frame B at the same instant, each in its own world.
struct PosePair {
  base::Time time;
  base::Transform estimate;  // X_EB
  base::Transform truth;     // X_TB
};

/// Truth is interpolated over gaps up to this one: at 10 Hz and 1 m/s² a straight line misses by a·dt²/8 = 1.3 mm.
inline constexpr base::Duration kLargestTruthGap = base::Milliseconds(150);

/// The truth at an instant: position linear, attitude along the shortest arc, between the poses before and after it.
/// None outside of the truth and in its gaps longer than `largest_gap` (a pose at the very instant always counts).
std::optional<base::Transform> TruthAt(const std::vector<base::StampedPose>& truth, base::Time time,
                                       base::Duration largest_gap = kLargestTruthGap);

/// Each pose of the estimate that has a truth, in its order. Both ascend in time.
std::vector<PosePair> Associate(const std::vector<base::StampedPose>& estimate,
                                const std::vector<base::StampedPose>& truth,
                                base::Duration largest_gap = kLargestTruthGap);

/// Distance along the true positions from the first pair to each pair, m; as many as there are pairs.
std::vector<double> PathOf(const std::vector<PosePair>& pairs);

}  // namespace alula::scenarios::trajectory
