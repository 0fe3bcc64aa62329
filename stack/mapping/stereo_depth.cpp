#include "stack/mapping/stereo_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/error.h"
#include "stack/mapping/internal/rectification.h"
#include "stack/mapping/internal/refine_disparity.h"

namespace alula::stack::mapping {

namespace {

constexpr float kUnmatched = -1.0F;  // disparity, px
constexpr float kPlain = -2.0F;      // the same: nothing to match

cv::Mat View(const Image& image, const internal::Rectification& r) {
  if (image.format != PixelFormat::kGrey8 || image.width < r.width || image.height < r.height || !image.bytes) {
    throw base::InputError("stereo depth: images must be grey and " + std::to_string(r.width) + "x" +
                           std::to_string(r.height) + ", as the calibration says");
  }
  // OpenCV has no const view; the pixels are only read.
  return cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.bytes->data()),
                 static_cast<std::size_t>(image.stride));
}

cv::Mat RectifiedHalf(const cv::Mat& image, const cv::Mat& map1, const cv::Mat& map2) {
  cv::Mat rectified;
  cv::Mat half;
  cv::remap(image, rectified, map1, map2, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::resize(rectified, half, cv::Size(rectified.cols / 2, rectified.rows / 2), 0, 0, cv::INTER_AREA);
  return half;
}

/// Raw disparities, px; kUnmatched where the matcher found nothing. The images are padded on the left, because the
/// matcher leaves out a strip as wide as its disparity range.
cv::Mat Match(const cv::Mat& left, const cv::Mat& right, int disparities, const StereoDepthConfig& c) {
  cv::Mat padded_left;
  cv::Mat padded_right;
  cv::copyMakeBorder(left, padded_left, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, padded_right, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  const int p1 = static_cast<int>(std::lround(8 * c.smoothness * c.block * c.block));
  const auto matcher =
      cv::StereoSGBM::create(0, disparities, c.block, p1, 4 * p1, static_cast<int>(std::lround(c.left_right_tolerance)),
                             31, c.uniqueness, 0, 0, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat fixed;  // 1/16 px
  matcher->compute(padded_left, padded_right, fixed);
  fixed = fixed.colRange(disparities, fixed.cols);
  if (c.speckle_area > 0) {
    fixed = fixed.clone();
    cv::filterSpeckles(fixed, -16, c.speckle_area, 16 * c.speckle_range);
  }
  cv::Mat disparity;
  fixed.convertTo(disparity, CV_32F, 1.0 / 16);
  disparity.setTo(kUnmatched, disparity < 0);
  return disparity;
}

/// Drops matches that another, nearer surface of the left view covers in the right view, and those outside it.
void RejectHidden(cv::Mat& disparity, double tolerance) {
  std::vector<float> nearest(disparity.cols);
  for (int v = 0; v < disparity.rows; ++v) {
    float* row = disparity.ptr<float>(v);
    std::fill(nearest.begin(), nearest.end(), 0.0F);
    for (int u = 0; u < disparity.cols; ++u) {
      const int right = u - static_cast<int>(std::lround(row[u]));
      if (row[u] >= 0 && right >= 0) nearest[right] = std::max(nearest[right], row[u]);
    }
    for (int u = 0; u < disparity.cols; ++u) {
      if (row[u] < 0) continue;
      const int right = u - static_cast<int>(std::lround(row[u]));
      if (right < 0 || nearest[right] > row[u] + static_cast<float>(tolerance)) row[u] = kUnmatched;
    }
  }
}

/// Drops matches where the window has nothing to match but noise.
void RejectPlain(const cv::Mat& left, const StereoDepthConfig& c, cv::Mat& disparity) {
  cv::Mat gradient;
  cv::Sobel(left, gradient, CV_16S, 1, 0, 1);
  cv::Mat strength;
  cv::convertScaleAbs(gradient, strength);
  cv::Mat mean;
  cv::boxFilter(strength, mean, CV_32F, cv::Size(c.texture_window, c.texture_window));
  disparity.setTo(kPlain, mean < c.min_texture);
}

/// Drops disparities that hang between the two sides of a depth edge: the flying pixels about thin bars.
void RejectFlying(double jump, cv::Mat& disparity) {
  cv::Mat low_input = disparity.clone();
  low_input.setTo(1e6, disparity < 0);
  const cv::Mat window = cv::Mat::ones(5, 5, CV_8U);
  cv::Mat low;
  cv::Mat high;
  cv::erode(low_input, low, window);
  cv::dilate(disparity, high, window);
  const float margin = static_cast<float>(0.5 * jump);
  for (int v = 0; v < disparity.rows; ++v) {
    float* d = disparity.ptr<float>(v);
    const float* l = low.ptr<float>(v);
    const float* h = high.ptr<float>(v);
    for (int u = 0; u < disparity.cols; ++u) {
      if (d[u] >= 0 && h[u] - l[u] > static_cast<float>(jump) && d[u] > l[u] + margin && d[u] < h[u] - margin) {
        d[u] = kUnmatched;
      }
    }
  }
}

}  // namespace

void Describe(base::Description& d, StereoDepthConfig& c) {
  d.Field("min_depth", c.min_depth,
          {.unit = "m", .meaning = "nearest depth that is matched; sets the disparity range", .min = 0.05, .max = 10});
  d.Field("block", c.block, {.meaning = "matching window, px at half size, odd", .min = 1, .max = 21});
  d.Field("smoothness", c.smoothness, {.meaning = "scale of the matcher's penalties", .min = 0.01, .max = 100});
  d.Field("uniqueness", c.uniqueness,
          {.meaning = "percent by which the best match must beat the second", .min = 0, .max = 100});
  d.Field("left_right_tolerance", c.left_right_tolerance,
          {.meaning = "disagreement allowed between the eyes, px", .min = 0, .max = 10});
  d.Field("speckle_area", c.speckle_area, {.meaning = "smaller islands are dropped, px²; 0: off", .min = 0});
  d.Field("speckle_range", c.speckle_range, {.meaning = "disparity jump that separates islands, px", .min = 0.1});
  d.Field("min_texture", c.min_texture,
          {.meaning = "mean horizontal gradient needed in the window, grey levels", .min = 0, .max = 255});
  d.Field("texture_window", c.texture_window, {.meaning = "window of that mean, px, odd", .min = 1, .max = 31});
  d.Field("edge_jump", c.edge_jump, {.meaning = "disparity jump that makes a depth edge, px", .min = 0.1});
  d.Field("refinements", c.refinements, {.meaning = "sub-pixel steps after matching", .min = 0, .max = 10});
  d.Field("refine_window", c.refine_window, {.meaning = "window of those steps, px, odd", .min = 3, .max = 31});
  d.Field("far_disparity", c.far_disparity,
          {.meaning = "valid disparities below this are farther than can be measured, px", .min = 0, .max = 10});
  d.Check("block", [&c] { return c.block % 2 == 1 ? "" : "must be odd; 5 is typical"; });
  d.Check("refine_window", [&c] { return c.refine_window % 2 == 1 ? "" : "must be odd; 7 is typical"; });
  d.Check("texture_window", [&c] { return c.texture_window % 2 == 1 ? "" : "must be odd; 7 is typical"; });
}

struct StereoDepth::Impl {
  StereoDepthConfig config;
  internal::Rectification rectification;
  int disparities = 16;  // px at half size, a multiple of 16
};

StereoDepth::StereoDepth(const Calibration& calibration, const StereoDepthConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->config = config;
  impl_->rectification = internal::MakeRectification(calibration);
  const double largest = 0.5 * impl_->rectification.focal * impl_->rectification.baseline / config.min_depth;
  impl_->disparities = std::max(1, static_cast<int>(std::ceil(largest / 16))) * 16;
}
StereoDepth::~StereoDepth() = default;
StereoDepth::StereoDepth(StereoDepth&&) noexcept = default;
StereoDepth& StereoDepth::operator=(StereoDepth&&) noexcept = default;

DepthMap StereoDepth::Compute(const Image& left_image, const Image& right_image) const {
  const internal::Rectification& r = impl_->rectification;
  const StereoDepthConfig& c = impl_->config;
  const cv::Mat left = RectifiedHalf(View(left_image, r), r.left_map1, r.left_map2);
  const cv::Mat right = RectifiedHalf(View(right_image, r), r.right_map1, r.right_map2);
  cv::Mat disparity = Match(left, right, impl_->disparities, c);
  RejectHidden(disparity, c.left_right_tolerance);
  RejectPlain(left, c, disparity);
  RejectFlying(c.edge_jump, disparity);
  for (int n = 0; n < c.refinements; ++n) internal::RefineDisparity(left, right, c.refine_window, disparity);

  DepthMap depth;
  depth.width = left.cols;
  depth.height = left.rows;
  depth.fx = depth.fy = 0.5 * r.focal;
  depth.cx = 0.5 * (r.cx - 0.5);  // a half-size pixel is the mean of pixels 2u and 2u + 1
  depth.cy = 0.5 * (r.cy - 0.5);
  depth.X_BC = r.X_BC;
  depth.baseline = r.baseline;
  depth.z.resize(static_cast<std::size_t>(depth.width) * depth.height);
  const float numerator = static_cast<float>(depth.fx * depth.baseline);
  for (int v = 0; v < depth.height; ++v) {
    const float* d = disparity.ptr<float>(v);
    float* z = depth.z.data() + static_cast<std::size_t>(v) * depth.width;
    for (int u = 0; u < depth.width; ++u) {
      if (d[u] < 0) {
        z[u] = d[u] == kPlain ? DepthMap::kPlain : 0.0F;
      } else if (d[u] < static_cast<float>(c.far_disparity)) {
        z[u] = std::numeric_limits<float>::infinity();
      } else {
        z[u] = numerator / d[u];
      }
    }
  }
  return depth;
}

}  // namespace alula::stack::mapping
