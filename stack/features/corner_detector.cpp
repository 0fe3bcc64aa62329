#include "stack/features/internal/corner_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

namespace alula::stack::features {
namespace {

constexpr int kHalf = 3;               // of the scored window, px
constexpr double kScharrScale = 32.0;  // OpenCV's Scharr kernel sums to 32 × the derivative
constexpr double kClearance = 12.0;    // px between a new corner and those that are there

struct Candidate {
  cv::Point2f point;
  double score = 0.0;
};

bool Crowded(const cv::Point2f& p, const std::vector<cv::Point2f>& taken) {
  return std::any_of(taken.begin(), taken.end(),
                     [&p](const cv::Point2f& t) { return std::hypot(p.x - t.x, p.y - t.y) < kClearance; });
}

}  // namespace

double CornerScore(const cv::Mat& gradient, int x, int y) {
  double xx = 0, xy = 0, yy = 0;
  for (int v = y - kHalf; v <= y + kHalf; ++v) {
    const auto* row = gradient.ptr<cv::Vec<short, 2>>(v);
    for (int u = x - kHalf; u <= x + kHalf; ++u) {
      const double gx = row[u][0], gy = row[u][1];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  const double count = (2 * kHalf + 1) * (2 * kHalf + 1) * kScharrScale * kScharrScale;
  const double mean = 0.5 * (xx + yy), half_difference = 0.5 * (xx - yy);
  return (mean - std::sqrt(half_difference * half_difference + xy * xy)) / count;
}

std::vector<cv::Point2f> FindCorners(const Pyramid& pyramid, const std::vector<cv::Point2f>& taken, int wanted,
                                     const StereoTrackerConfig& config) {
  if (wanted <= 0) return {};
  const cv::Mat& image = pyramid.image(0);
  const cv::Mat& gradient = pyramid.gradient(0);
  const int columns = (image.cols + config.cell - 1) / config.cell;
  const int rows = (image.rows + config.cell - 1) / config.cell;
  const auto cell_of = [&](const cv::Point2f& p) {
    const int c = std::clamp(static_cast<int>(p.x) / config.cell, 0, columns - 1);
    const int r = std::clamp(static_cast<int>(p.y) / config.cell, 0, rows - 1);
    return static_cast<std::size_t>(r * columns + c);
  };
  std::vector<bool> full(static_cast<std::size_t>(rows * columns), false);
  for (const cv::Point2f& p : taken) full[cell_of(p)] = true;

  std::vector<cv::KeyPoint> proposals;
  cv::FAST(image, proposals, config.fast_threshold, true);
  std::vector<Candidate> best(full.size());
  const float border = static_cast<float>(config.border);
  for (const cv::KeyPoint& k : proposals) {
    const std::size_t cell = cell_of(k.pt);
    if (full[cell] || k.pt.x < border || k.pt.y < border || k.pt.x > static_cast<float>(image.cols) - 1 - border ||
        k.pt.y > static_cast<float>(image.rows) - 1 - border) {
      continue;
    }
    const double score = CornerScore(gradient, static_cast<int>(k.pt.x), static_cast<int>(k.pt.y));
    if (score < config.min_corner_score || score <= best[cell].score || Crowded(k.pt, taken)) continue;
    best[cell] = {k.pt, score};
  }
  std::erase_if(best, [](const Candidate& c) { return c.score <= 0.0; });
  std::stable_sort(best.begin(), best.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  if (best.size() > static_cast<std::size_t>(wanted)) best.resize(static_cast<std::size_t>(wanted));
  std::vector<cv::Point2f> corners;
  for (const Candidate& c : best) corners.push_back(c.point);
  return corners;
}

}  // namespace alula::stack::features
