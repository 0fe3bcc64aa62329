#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/frames.h"
#include "stack/features/stereo_tracker_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// An image with its coarser levels and, where asked for, the Scharr gradients of each (OpenCV's layout: image,
/// gradient, image, …). Following from a pyramid with gradients is cheaper.
struct Pyramid {
  std::vector<cv::Mat> levels;
  bool with_gradients = false;
  const cv::Mat& image(int level) const { return levels[static_cast<std::size_t>(with_gradients ? 2 * level : level)]; }
  const cv::Mat& gradient(int level) const { return levels[static_cast<std::size_t>(2 * level + 1)]; }
};

/// Throws base::InputError where the image is not 8-bit grey of width × height.
Pyramid BuildPyramid(const Image& image, int width, int height, bool with_gradients, const StereoTrackerConfig& config);

/// Result of following one point.
struct Flow {
  cv::Point2f to;
  bool found = false;
};

/// Pyramidal Lucas–Kanade (Bouguet 2001) of `from` points with first guesses `guess`, from the finest to `top` level.
/// With `check_back`, each point is followed back, and one that does not return to within max_back_error is lost.
std::vector<Flow> FollowPoints(const Pyramid& a, const Pyramid& b, const std::vector<cv::Point2f>& from,
                               const std::vector<cv::Point2f>& guess, int top, bool check_back,
                               const StereoTrackerConfig& config);

}  // namespace alula::stack::features
