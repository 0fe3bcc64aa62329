#pragma once

#include <vector>

#include "base/frames.h"

namespace alula::stack::mapping {

/// Planar depth (along the optical axis) of an undistorted, rectified left camera. Pixel (u, v) looks along
/// ((u − cx)/fx, (v − cy)/fy, 1) in the camera frame C; integer coordinates are pixel centres.
struct DepthMap {
  static constexpr float kPlain = -1.0F;

  int width = 0;
  int height = 0;
  double fx = 0.0;  // px
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  /// Row by row, m. 0: unknown. +inf: certainly farther than can be measured ("free to the limit"). kPlain: unknown,
  /// because there is nothing to match, as in a clear sky.
  std::vector<float> z;
  base::Transform X_BC;   // of this rectified camera, not of the physical one
  double baseline = 0.0;  // m; with fx it gives the depth's uncertainty: σ_z = z² σ_disparity / (fx · baseline)

  float At(int u, int v) const { return z[static_cast<std::size_t>(v) * width + u]; }
  base::Vec3 Ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
  /// 1σ of a depth at z (m) for a disparity error of `disparity_sigma` px of this map.
  double Sigma(double depth, double disparity_sigma) const { return depth * depth * disparity_sigma / (fx * baseline); }
};

}  // namespace alula::stack::mapping
