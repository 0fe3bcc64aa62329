#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/frames.h"
#include "stack/features/descriptor.h"
#include "stack/features/orb_config.h"
#include "stack/features/stereo_rig.h"
#include "stack/interface/measurement.h"

namespace alula::stack::slam {

/// A corner of a keyframe, by which its place is known again.
struct PlacePoint {
  base::Vec2 pixel = base::Vec2::Zero();
  base::Vec2 normalised = base::Vec2::Zero();  // without lens distortion, x/z, y/z
  double scale = 1.0;  // px of the image a px of its octave: its 1σ is `scale` × that of octave 0
  double angle = 0.0;  // rad, in the image
  features::Descriptor descriptor{};
  std::optional<base::Vec3> p_C{};  // m, camera frame, where the depth is known
};

/// A line segment of a keyframe.
struct PlaceLine {
  std::array<base::Vec2, 2> pixels{base::Vec2::Zero(), base::Vec2::Zero()};      // its ends
  std::array<base::Vec2, 2> normalised{base::Vec2::Zero(), base::Vec2::Zero()};  // without lens distortion
  features::Descriptor descriptor{};
  std::optional<std::array<base::Vec3, 2>> ends_C{};  // m, camera frame, where the depth is known
};

/// What a keyframe shows for recognition: plain data, the same whichever sensors it came from.
struct PlaceView {
  std::vector<PlacePoint> points;
  std::vector<PlaceLine> lines;
  double focal = 0.0;  // px
  /// px·m, how sure depths are: σ_z = z²/focal_baseline per px of disparity. Of a depth camera or of landmarks that
  /// were seen from several places, what gives their σ_z. Above 0 where any depth is known.
  double focal_baseline = 0.0;
  /// Unit vector against gravity in the camera frame, where an IMU knows it.
  std::optional<base::Vec3> up_C{};
};

/// What a frame shows: ORB keypoints of the left image with the depths that the rig measures; no lines. Throws
/// base::InputError as DetectOrb and KeypointDepths do.
PlaceView ViewOf(const features::StereoRig& rig, const Image& left, const Image& right,
                 const features::OrbConfig& config, const DepthImage& depth = {});

}  // namespace alula::stack::slam
