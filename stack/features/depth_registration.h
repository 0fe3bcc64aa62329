#pragma once

#include <array>
#include <vector>

#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// True where pixel (u, v) of one camera is pixel (u, v) of the other: same place, same lens.
bool Registered(const CameraCalibration& a, const CameraCalibration& b);

/// Draws depth images of one camera as another one beside it would see them: each pixel becomes the point
/// p_C = X_CD (z · ray), which lands at its pixel of camera C with its depth p_C.z there, as a square a tenth
/// larger than the pixel is in C; of two points in one pixel the nearer one counts. What C sees and D does not stays 0.
class DepthRegistration {
 public:
  DepthRegistration(const CameraCalibration& depth, const CameraCalibration& into);

  /// The image has the size of the depth camera, the result that of the other one; stamps are kept.
  DepthImage operator()(const DepthImage& image) const;

 private:
  CameraIntrinsics into_;
  base::Transform X_CD_;
  int width_ = 0, height_ = 0;                // of the depth camera
  std::array<double, 2> magnification_{};     // of focal lengths, into / from, along u and v
  std::vector<Eigen::Vector3f> turned_rays_;  // R_CD (x/z, y/z, 1) of each pixel
};

}  // namespace alula::stack::features
