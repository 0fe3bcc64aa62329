#pragma once

#include <optional>
#include <vector>

#include "base/frames.h"
#include "stack/features/orb.h"
#include "stack/features/stereo_rig.h"
#include "stack/features/stereo_tracker_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::slam {

/// A keypoint as a keyframe remembers it.
struct KeyframeFeature {
  base::Vec2 pixel = base::Vec2::Zero();  // left image
  base::Vec2 left = base::Vec2::Zero();   // normalised, left camera
  std::optional<base::Vec2> right;        // normalised, right camera
  double depth = 0.0;                     // m by stereo, 0 where unknown
  int octave = 0;                         // pyramid level that it was found on
  features::Descriptor descriptor{};
};
using KeyframeFeatures = std::vector<KeyframeFeature>;

/// ORB keypoints of the left image, matched into the right one.
KeyframeFeatures FindKeyframeFeatures(const Image& left, const Image& right, const features::StereoRig& rig,
                                      const features::OrbConfig& orb, const features::StereoTrackerConfig& stereo);

}  // namespace alula::stack::slam
