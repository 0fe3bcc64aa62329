#include "stack/mapping/internal/refine_disparity.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace alula::stack::mapping::internal {

namespace {

constexpr float kMaxStep = 0.5F;          // px
constexpr float kMinInformation = 20.0F;  // summed squared gradient of the window, grey levels²; below: leave as it is

cv::Mat Smoothed(const cv::Mat& image) {
  cv::Mat smooth;
  cv::GaussianBlur(image, smooth, cv::Size(3, 3), 0.7);
  cv::Mat result;
  smooth.convertTo(result, CV_32F);
  return result;
}

cv::Mat RowGradient(const cv::Mat& image) {
  const cv::Mat kernel = (cv::Mat_<float>(1, 3) << -0.5F, 0.0F, 0.5F);
  cv::Mat gradient;
  cv::filter2D(image, gradient, CV_32F, kernel);
  return gradient;
}

cv::Mat WindowSum(const cv::Mat& image, int window) {
  cv::Mat sum;
  cv::boxFilter(image, sum, CV_32F, cv::Size(window, window), cv::Point(-1, -1), false);
  return sum;
}

}  // namespace

void RefineDisparity(const cv::Mat& left_grey, const cv::Mat& right_grey, int window, cv::Mat& disparity) {
  const cv::Mat left = Smoothed(left_grey);
  const cv::Mat right = Smoothed(right_grey);
  cv::Mat map_x(disparity.size(), CV_32F);
  cv::Mat map_y(disparity.size(), CV_32F);
  cv::Mat matched(disparity.size(), CV_32F);
  for (int v = 0; v < disparity.rows; ++v) {
    const float* d = disparity.ptr<float>(v);
    float* x = map_x.ptr<float>(v);
    float* y = map_y.ptr<float>(v);
    float* m = matched.ptr<float>(v);
    for (int u = 0; u < disparity.cols; ++u) {
      m[u] = d[u] >= 0 ? 1.0F : 0.0F;
      x[u] = static_cast<float>(u) - std::max(0.0F, d[u]);
      y[u] = static_cast<float>(v);
    }
  }
  cv::Mat warped;
  cv::Mat warped_gradient;
  cv::remap(right, warped, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  cv::remap(RowGradient(right), warped_gradient, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  const cv::Mat gradient = 0.5 * (RowGradient(left) + warped_gradient);
  const cv::Mat g = gradient.mul(matched);
  const cv::Mat e = (left - warped).mul(matched);
  const cv::Mat count = WindowSum(matched, window);
  const cv::Mat sum_g = WindowSum(g, window);
  const cv::Mat sum_e = WindowSum(e, window);
  const cv::Mat sum_gg = WindowSum(g.mul(g), window);
  const cv::Mat sum_ge = WindowSum(g.mul(e), window);
  for (int v = 0; v < disparity.rows; ++v) {
    float* d = disparity.ptr<float>(v);
    for (int u = 0; u < disparity.cols; ++u) {
      if (d[u] < 0) continue;
      const float n = count.at<float>(v, u);
      const float mean_g = sum_g.at<float>(v, u) / n;
      const float information = sum_gg.at<float>(v, u) - n * mean_g * mean_g;
      if (information < kMinInformation) continue;
      const float step = -(sum_ge.at<float>(v, u) - mean_g * sum_e.at<float>(v, u)) / information;
      d[u] = std::max(0.0F, d[u] + std::clamp(step, -kMaxStep, kMaxStep));
    }
  }
}

}  // namespace alula::stack::mapping::internal
