#pragma once

#include <cstdint>
#include <vector>

#include "base/trajectory_file.h"

namespace alula::scenarios::trajectory {

/// How much of a recording an estimate covers. What counts are the images from the first to the last one that lies
/// within the truth (all of them without a truth): before and after it nothing can be said.
struct Completeness {
  std::int64_t images = 0;       // that count
  std::int64_t with_pose = 0;    // of these; a pose belongs to an image if it is at most half a period away
  base::Duration until_first{};  // from the first image that counts to the first pose; all of it without any pose
  base::Duration longest_gap{};  // after that, between one pose and the next one or the last image

  double share() const { return images == 0 ? 0.0 : static_cast<double>(with_pose) / static_cast<double>(images); }
};

/// All ascend in time; the period is the median of the images'.
Completeness CompletenessOf(const std::vector<base::Time>& images, const std::vector<base::StampedPose>& estimate,
                            const std::vector<base::StampedPose>& truth);

}  // namespace alula::scenarios::trajectory
