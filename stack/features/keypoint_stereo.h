#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/frames.h"
#include "stack/features/stereo_rig.h"
#include "stack/features/stereo_tracker_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// A point of the left image as the right one shows it, normalised.
struct StereoSight {
  base::Vec2 right = base::Vec2::Zero();
  double depth = 0.0;  // m along the left optical axis; negative where the rays diverge
};

/// Finds pixels of the left image in the right one of the same instant, to a part of a pixel: a search along the
/// epipolar line, then Lucas–Kanade and back. One answer a pixel. Throws base::InputError for images that are not 8-bit
/// grey of the calibrated size.
std::vector<std::optional<StereoSight>> FindInRightEye(const Image& left, const Image& right,
                                                       std::span<const base::Vec2> pixels, const StereoRig& rig,
                                                       const StereoTrackerConfig& config);

}  // namespace alula::stack::features
