#pragma once

#include "base/frames.h"
#include "stack/interface/calibration.h"

namespace alula::stack {

// The equations of a camera, the same for those who draw pictures and those who read them.
//
// Radial-tangential (Brown 1971), with x, y = p_x/p_z, p_y/p_z and r² = x² + y²:
//   x_d = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²),   y_d likewise with p1 and p2 changed over.
// Equidistant (Kannala and Brandt 2006), with θ the angle between ray and optical axis:
//   θ_d = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸),   (x_d, y_d) = θ_d (p_x, p_y) / |(p_x, p_y)|.
// Both: u = fx x_d + cx, v = fy y_d + cy.

/// True where the model is the plain pinhole: u = fx x/z + cx.
bool IsPinhole(const CameraIntrinsics& camera);

/// Distorted image-plane point (x_d, y_d) of an undistorted one (x/z, y/z).
base::Vec2 Distort(const CameraIntrinsics& camera, const base::Vec2& normalised);

/// Pixel → undistorted normalised image coordinates (x/z, y/z), by Newton's method; exact where there is no distortion.
/// A fisheye's pixels at 90° from the axis and beyond have none: for those use Ray.
base::Vec2 Normalise(const CameraIntrinsics& camera, const base::Vec2& pixel);

/// Pixel → unit vector in the camera frame, for either model.
base::Vec3 Ray(const CameraIntrinsics& camera, const base::Vec2& pixel);

/// Point in the camera frame → pixel. z > 0 for the radial-tangential model; any point off the negative axis for the
/// equidistant one.
base::Vec2 Project(const CameraIntrinsics& camera, const base::Vec3& p_C);

/// True where the pixel lies at least `border` px inside the image.
bool Inside(const CameraIntrinsics& camera, const base::Vec2& pixel, double border);

/// The largest angle from the optical axis (rad) up to which the model is one-to-one: beyond it the polynomial folds
/// the picture back. π for a lens without a fold.
double LargestAngle(const CameraIntrinsics& camera);

}  // namespace alula::stack
