#pragma once

#include <opencv2/core.hpp>

#include "stack/interface/calibration.h"

namespace alula::stack::mapping::internal {

/// Turns both eyes to look along a common axis, perpendicular to the baseline, with rows that correspond.
struct Rectification {
  base::Transform X_BC;   // of the rectified left camera; the right one stands `baseline` m along its x axis
  double baseline = 0.0;  // m
  double focal = 0.0;     // px, full size, both axes
  double cx = 0.0;
  double cy = 0.0;
  int width = 0;  // px, full size
  int height = 0;
  cv::Mat left_map1, left_map2;  // for cv::remap, fixed point
  cv::Mat right_map1, right_map2;
};

/// Throws base::InputError when there is no stereo pair, sizes differ, or the baseline does not run to the left eye's
/// right-hand side.
Rectification MakeRectification(const Calibration& calibration);

}  // namespace alula::stack::mapping::internal
