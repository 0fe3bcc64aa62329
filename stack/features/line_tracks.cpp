#include "stack/features/line_tracks.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace alula::stack::features {

using base::Vec2;
using base::Vec3;

std::optional<LineSegment> ExpectSegment(const CameraIntrinsics& camera, const Vec3& a_C, const Vec3& b_C) {
  constexpr double kNearest = 0.1;  // m
  constexpr int kSteps = 16;        // of the way that is looked through for what is inside
  std::optional<Vec2> first, last;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p = a_C + (b_C - a_C) * (static_cast<double>(i) / kSteps);
    if (p.z() < kNearest) continue;
    const Vec2 pixel = Project(camera, p);
    if (!Inside(camera, pixel, 1.0)) continue;
    if (!first) first = pixel;
    last = pixel;
  }
  if (!first || (*last - *first).norm() < 1.0) return std::nullopt;
  return LineSegment{*first, *last, 0.0};
}

std::vector<FollowedLine> FollowLines(const std::vector<ExpectedLine>& expected,
                                      const std::vector<LineSegment>& segments, const LineTrackConfig& config) {
  std::vector<std::tuple<double, std::size_t, int>> pairs;  // cost, expected, segment
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const LineSegment& e = expected[i].segment;
    const Vec2 along = e.Along();
    const double length = e.Length();
    for (std::size_t j = 0; j < segments.size(); ++j) {
      const LineSegment& s = segments[j];
      const Vec2 way = s.Along();
      const double turn = std::atan2(along.x() * way.y() - along.y() * way.x(), along.dot(way));
      if (std::abs(turn) > config.max_angle) continue;
      const Vec2 d = s.Middle() - e.a;
      const double t = along.dot(d), offset = std::abs(along.x() * d.y() - along.y() * d.x());
      if (offset > config.max_offset) continue;
      const double half = 0.5 * s.Length();
      const double overlap = std::min(length, t + half) - std::max(0.0, t - half);
      if (overlap < config.min_overlap * std::min(length, s.Length())) continue;
      pairs.emplace_back(offset / config.max_offset + std::abs(turn) / config.max_angle, i, static_cast<int>(j));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> followed(expected.size(), false), used(segments.size(), false);
  std::vector<FollowedLine> result;
  for (const auto& [cost, i, j] : pairs) {
    if (followed[i] || used[static_cast<std::size_t>(j)]) continue;
    followed[i] = used[static_cast<std::size_t>(j)] = true;
    result.push_back({expected[i].id, j});
  }
  std::sort(result.begin(), result.end(), [](const FollowedLine& a, const FollowedLine& b) { return a.id < b.id; });
  return result;
}

}  // namespace alula::stack::features
