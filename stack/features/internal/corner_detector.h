#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stack/features/internal/pyramid.h"
#include "stack/features/stereo_tracker_config.h"

namespace alula::stack::features {

/// Smaller eigenvalue of the mean gradient matrix over 7×7 px around (x, y), (grey level/px)² (Shi and Tomasi 1994).
/// `gradient`: OpenCV's Scharr gradients of a pyramid level, 32 × the derivative.
double CornerScore(const cv::Mat& gradient, int x, int y);

/// The best corner of each grid cell that holds none of `taken`, at most `wanted`, strongest first: FAST proposes,
/// CornerScore chooses.
std::vector<cv::Point2f> FindCorners(const Pyramid& pyramid, const std::vector<cv::Point2f>& taken, int wanted,
                                     const StereoTrackerConfig& config);

}  // namespace alula::stack::features
