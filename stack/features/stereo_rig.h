#pragma once

#include <cstdint>
#include <optional>

#include "base/frames.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::features {

/// What tells the depth of what the left camera sees.
enum class DepthSource : std::uint8_t {
  kStereo,       // a second camera
  kDepthCamera,  // depth images, drawn as the left camera sees; they stand for a second eye that is not there
  kNone,         // motion alone
};

/// A camera, and a second one that sees with it. With a depth camera the right one is made up: a pinhole of the left
/// one's size beside it, in which what is seen at depth z lies f·b/z px farther left. That gives depths the noise of a
/// pair's, σ_z = z² σ_px / (f b), and all that follows is the same for both. Without depth there is no right one.
struct StereoRig {
  CameraIntrinsics left, right;
  base::Transform X_LR;  // pose of the right camera in the left one's frame
  DepthSource depth = DepthSource::kStereo;
};

/// The pair that the calibration names. Throws base::InputError where there is none.
StereoRig MakeRig(const Calibration& calibration);

/// One camera alone, or with depth images and `virtual_baseline` (m).
StereoRig MakeRig(const CameraCalibration& camera, std::optional<double> virtual_baseline);

/// Where the made-up right eye sees what the left one sees (normalised) at a depth (m).
base::Vec2 VirtualRight(const StereoRig& rig, const base::Vec2& left, double depth);

/// Depth (m) along the left ray at which the rays of a match are nearest; negative for rays that diverge.
double TriangulatedDepth(const base::Transform& X_LR, const base::Vec2& left, const base::Vec2& right);

}  // namespace alula::stack::features
