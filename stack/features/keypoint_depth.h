#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/frames.h"
#include "stack/features/stereo_rig.h"
#include "stack/features/stereo_tracker_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// Depth (m, along the left camera's axis) of pixels of the left image by stereo, one answer each: searched for along
/// the epipolar line in the right image of the same instant, refined to a fraction of a pixel and checked back. None
/// where nothing like it is there, or as far as infinity. Throws base::InputError for images that are not 8-bit grey or
/// not of the calibrated size.
std::vector<std::optional<double>> KeypointDepths(const StereoRig& rig, const Image& left, const Image& right,
                                                  std::span<const base::Vec2> pixels,
                                                  const StereoTrackerConfig& config = {});

/// Depth (m) at a pixel of a depth image; none where too little around it was measured, or an edge of depth runs by.
/// `pixel` lies in the image.
std::optional<double> DepthAt(const DepthImage& depth, const base::Vec2& pixel);

/// The same from whatever the rig measures depth with; all none where that is nothing.
std::vector<std::optional<double>> KeypointDepths(const StereoRig& rig, const Image& left, const Image& right,
                                                  const DepthImage& depth, std::span<const base::Vec2> pixels);

}  // namespace alula::stack::features
