#pragma once

#include "base/frames.h"
#include "stack/interface/calibration.h"

namespace alula::stack::features {

/// Radial-tangential distortion of a normalised point (x/z, y/z): k1 k2 p1 p2 k3 (Brown 1971, as OpenCV orders them).
base::Vec2 Distort(const CameraIntrinsics& camera, const base::Vec2& normalised);

/// Pixel → undistorted normalised image coordinates (x/z, y/z). Inverts Distort by Newton's method; exact where there
/// is no distortion.
base::Vec2 Normalise(const CameraIntrinsics& camera, const base::Vec2& pixel);

/// Point in the camera frame (z > 0) → pixel.
base::Vec2 Project(const CameraIntrinsics& camera, const base::Vec3& p_C);

/// True where the pixel lies at least `border` px inside the image.
bool Inside(const CameraIntrinsics& camera, const base::Vec2& pixel, double border);

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
