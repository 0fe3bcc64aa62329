#pragma once

#include "base/frames.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::features {

/// Two cameras that see together.
struct StereoRig {
  CameraIntrinsics left, right;
  base::Transform X_LR;  // pose of the right camera in the left one's frame
};

/// The pair that the calibration names. Throws base::InputError where there is none.
StereoRig MakeRig(const Calibration& calibration);

/// Depth (m) along the left ray at which the rays of a match are nearest; negative for rays that diverge.
double TriangulatedDepth(const base::Transform& X_LR, const base::Vec2& left, const base::Vec2& right);

}  // namespace alula::stack::features
