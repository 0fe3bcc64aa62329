#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scenarios/check/camera_bench.h"

namespace alula::scenarios::check {

/// Inner corners of the board found in a picture, in the board's order; nothing where it is not found whole.
/// `expected`: roughly where they should be; it tells the board's two ways round apart and how small its squares are.
std::optional<std::vector<base::Vec2>> FindBoard(const Frame& frame, const std::vector<base::Vec2>& expected);

/// A camera as its pictures of the board say, from no prior knowledge but its kind of lens.
struct CalibratedCamera {
  stack::CameraIntrinsics intrinsics;
  std::array<double, 4> optics_sigma{};      // standard deviations of fx, fy, cx, cy, px
  std::array<double, 5> distortion_sigma{};  // of the coefficients; 0 where held at 0
  std::vector<base::Transform> X_CT;         // of the board, by view
  double rmse = 0.0;                         // of reprojection, px (both coordinates together)
};

/// What is to be estimated: image size, kind of lens, and which coefficients are held at 0.
struct LensKind {
  int width = 0, height = 0;
  stack::DistortionModel model = stack::DistortionModel::kRadialTangential;
  std::array<bool, 5> free{};
};

/// Calibrates by OpenCV (Zhang 2000; for fisheyes Kannala and Brandt 2006) from each view's corners. Standard
/// deviations are those of the joint least squares with the boards' poses eliminated (Schur complement), scaled by the
/// residuals. Throws base::FaultError where it cannot be solved.
CalibratedCamera CalibrateCamera(const LensKind& kind, const std::vector<std::vector<base::Vec2>>& views);

/// Pose of the second camera in the first one from boards that both saw, their intrinsics fixed.
base::Transform CalibratePair(const stack::CameraIntrinsics& first, const stack::CameraIntrinsics& second,
                              const std::vector<std::vector<base::Vec2>>& views_first,
                              const std::vector<std::vector<base::Vec2>>& views_second);

}  // namespace alula::scenarios::check
