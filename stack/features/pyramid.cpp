#include "stack/features/internal/pyramid.h"

#include <cmath>
#include <opencv2/video/tracking.hpp>

#include "base/error.h"

namespace alula::stack::features {

Pyramid BuildPyramid(const Image& image, int width, int height, bool with_gradients,
                     const StereoTrackerConfig& config) {
  if (image.format != PixelFormat::kGrey8 || image.width != width || image.height != height || !image.bytes) {
    throw base::InputError("stereo tracker: expected an 8-bit grey image of the calibrated size");
  }
  // The pyramid copies level 0 (with its border), so nothing writes to the shared pixels.
  const cv::Mat view(height, width, CV_8UC1, const_cast<std::uint8_t*>(image.Row(0)),
                     static_cast<std::size_t>(image.stride));
  Pyramid pyramid;
  pyramid.with_gradients = with_gradients;
  cv::buildOpticalFlowPyramid(view, pyramid.levels, cv::Size(config.window, config.window), config.levels,
                              with_gradients, cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
  return pyramid;
}

std::vector<Flow> FollowPoints(const Pyramid& a, const Pyramid& b, const std::vector<cv::Point2f>& from,
                               const std::vector<cv::Point2f>& guess, int top, bool check_back,
                               const StereoTrackerConfig& config) {
  std::vector<Flow> flow(from.size());
  if (from.empty()) return flow;
  const cv::Size window(config.window, config.window);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, config.iterations, 0.01);
  const double min_eigenvalue = 1e-4;
  std::vector<cv::Point2f> to = guess;
  std::vector<std::uint8_t> found;
  cv::calcOpticalFlowPyrLK(a.levels, b.levels, from, to, found, cv::noArray(), window, top, stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW, min_eigenvalue);
  for (std::size_t i = 0; i < from.size(); ++i) {
    flow[i].to = to[i];
    flow[i].found = found[i] != 0;
  }
  if (!check_back) return flow;

  std::vector<std::size_t> index;
  std::vector<cv::Point2f> there, back;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!flow[i].found) continue;
    index.push_back(i);
    there.push_back(to[i]);
    back.push_back(from[i]);
  }
  if (index.empty()) return flow;
  // The way back begins at its goal on the fine levels alone: it asks whether the match is a mutual minimum.
  cv::calcOpticalFlowPyrLK(b.levels, a.levels, there, back, found, cv::noArray(), window, std::min(top, 1), stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW, min_eigenvalue);
  for (std::size_t k = 0; k < index.size(); ++k) {
    const cv::Point2f miss = back[k] - from[index[k]];
    if (found[k] == 0 || std::hypot(miss.x, miss.y) > config.max_back_error) flow[index[k]].found = false;
  }
  return flow;
}

}  // namespace alula::stack::features
