#pragma once

#include <opencv2/core.hpp>

namespace alula::stack::mapping::internal {

/// Sharpens disparities (CV_32F, px; negative: unmatched) by one step of Lucas and Kanade (1981) along the rows, in
/// a window of window×window pixels: with L(u) ≈ R(u − d − δ), δ = −Σ g (e − ē) / Σ g (g − ḡ), e = L − R(u − d), g the
/// gradient. Semi-global matching draws fractions of a pixel towards whole pixels, alike on a whole fronto-parallel
/// surface; this removes the pull. Steps are cut at half a pixel.
void RefineDisparity(const cv::Mat& left, const cv::Mat& right, int window, cv::Mat& disparity);

}  // namespace alula::stack::mapping::internal
