#include "stack/features/line_segments.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "stack/features/internal/edge_lines.h"

namespace alula::stack::features {
namespace {

using base::Vec2;

void SortByLength(std::vector<LineSegment>& lines) {
  std::stable_sort(lines.begin(), lines.end(),
                   [](const LineSegment& a, const LineSegment& b) { return a.Length() > b.Length(); });
}

double MeanLength(const std::vector<LineSegment>& lines) {
  double sum = 0.0;
  for (const LineSegment& line : lines) sum += line.Length();
  return lines.empty() ? 0.0 : sum / static_cast<double>(lines.size());
}

/// LSD gives the darker side always on the same hand; ours is the other.
std::vector<LineSegment> Lsd(const cv::Mat& image) {
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(image, found);
  cv::Mat gx, gy;
  cv::Sobel(image, gx, CV_16S, 1, 0);
  cv::Sobel(image, gy, CV_16S, 0, 1);
  std::vector<LineSegment> lines;
  for (const cv::Vec4f& f : found) {
    LineSegment line{{f[0], f[1]}, {f[2], f[3]}, 0.0};
    const double length = line.Length();
    if (length < 1.0) continue;
    const Vec2 along = line.Along(), normal(-along.y(), along.x());
    double sum = 0.0;
    const int steps = std::max(2, static_cast<int>(length));
    for (int i = 0; i <= steps; ++i) {
      const Vec2 p = line.a + (line.b - line.a) * (static_cast<double>(i) / steps);
      const int u = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.cols - 1);
      const int v = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.rows - 1);
      sum += normal.dot(Vec2(gx.at<std::int16_t>(v, u), gy.at<std::int16_t>(v, u)));
    }
    if (sum < 0.0) std::swap(line.a, line.b);
    line.contrast = std::abs(sum) / (8.0 * (steps + 1));
    lines.push_back(line);
  }
  return lines;
}

/// Distance of a point from a segment's line, with its sign.
double Offset(const LineSegment& line, const Vec2& p) {
  const Vec2 along = line.Along(), d = p - line.a;
  return along.x() * d.y() - along.y() * d.x();
}

/// The segment through both, where `other` nearly continues `line`, the longer one; false where it does not.
bool Merge(LineSegment& line, const LineSegment& other, const LineConfig& config) {
  const Vec2 along = line.Along();
  // The angle by horizontal and vertical distances alone: |sin| of it, the directions alike.
  const Vec2 way = other.b - other.a;
  const double length = line.Length(), shorter = other.Length();
  if (along.dot(way) <= 0.0) return false;
  if (std::abs(along.x() * way.y() - along.y() * way.x()) > std::sin(config.merge_angle) * shorter) return false;
  if (std::abs(Offset(line, other.a)) > config.merge_offset || std::abs(Offset(line, other.b)) > config.merge_offset)
    return false;
  const double from = along.dot(other.a - line.a), to = along.dot(other.b - line.a);
  const double gap = std::max(from - length, -to);
  if (gap > config.merge_gap * shorter) return false;
  // Through the four ends, each line's by its length.
  const Vec2 first = from < 0.0 ? other.a : line.a, last = to > length ? other.b : line.b;
  const double w = length / (length + shorter);
  const Vec2 middle = w * line.Middle() + (1.0 - w) * other.Middle();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& [p, weight] :
       {std::pair{line.a, w}, std::pair{line.b, w}, std::pair{other.a, 1.0 - w}, std::pair{other.b, 1.0 - w}})
    spread += weight * (p - middle) * (p - middle).transpose();
  const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  Vec2 direction(std::cos(angle), std::sin(angle));
  if (direction.dot(along) < 0.0) direction = -direction;
  const double contrast = w * line.contrast + (1.0 - w) * other.contrast;
  line = {middle + direction.dot(first - middle) * direction, middle + direction.dot(last - middle) * direction,
          contrast};
  return true;
}

}  // namespace

std::vector<LineSegment> ReduceLines(std::vector<LineSegment> segments, int width, int height,
                                     const LineConfig& config) {
  SortByLength(segments);
  const double least = config.min_share * std::min(width, height);
  std::erase_if(segments, [least](const LineSegment& s) { return s.Length() < least; });
  std::vector<bool> gone(segments.size(), false);
  std::vector<LineSegment> kept;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (gone[i]) continue;
    LineSegment line = segments[i];
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        if (gone[j] || !Merge(line, segments[j], config)) continue;
        gone[j] = grew = true;
      }
    }
    kept.push_back(line);
  }
  SortByLength(kept);
  if (kept.size() > static_cast<std::size_t>(config.keep)) kept.resize(static_cast<std::size_t>(config.keep));
  return kept;
}

std::vector<LineSegment> DetectLines(const Image& image, const LineConfig& config, LineCounts* counts) {
  if (image.format != PixelFormat::kGrey8 || image.width < 16 || image.height < 16)
    throw base::InputError("lines: the image is not 8-bit grey of at least 16 x 16 px");
  const cv::Mat full(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.Row(0)),
                     static_cast<std::size_t>(image.stride));
  cv::Mat searched = full;
  if (config.half) cv::resize(full, searched, {image.width / 2, image.height / 2}, 0, 0, cv::INTER_AREA);
  std::vector<LineSegment> lines = config.detector == LineDetector::kLsd ? Lsd(searched) : EdgeLines(searched, config);
  if (config.half) {
    for (LineSegment& line : lines) {
      line.a = 2.0 * line.a + Vec2::Constant(0.5);
      line.b = 2.0 * line.b + Vec2::Constant(0.5);
      line.contrast *= 0.5;
    }
  }
  SortByLength(lines);
  if (counts != nullptr) {
    counts->found = static_cast<int>(lines.size());
    counts->found_length = MeanLength(lines);
  }
  if (config.reduce) lines = ReduceLines(std::move(lines), image.width, image.height, config);
  if (counts != nullptr) {
    counts->kept = static_cast<int>(lines.size());
    counts->kept_length = MeanLength(lines);
  }
  return lines;
}

}  // namespace alula::stack::features
