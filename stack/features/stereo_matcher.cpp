#include "stack/features/internal/stereo_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace alula::stack::features {
namespace {

using base::Vec2;
using base::Vec3;

constexpr int kHalf = 4;  // of the searched patch at half resolution, px
constexpr int kSide = 2 * kHalf + 1;
constexpr double kUnique = 0.85;    // the best must be this much better than the next best elsewhere
constexpr double kMaxMisfit = 0.6;  // of the patch's own contrast: eyes of unequal gain leave a part of it
constexpr int kNoise = 3;           // grey levels a pixel that noise alone leaves
using Patch = std::array<int, kSide * kSide>;

/// A patch with its mean removed; false at the image's edge.
bool ReadPatch(const cv::Mat& image, int x, int y, Patch& patch) {
  if (x < kHalf || y < kHalf || x >= image.cols - kHalf || y >= image.rows - kHalf) return false;
  int sum = 0;
  std::size_t k = 0;
  for (int v = y - kHalf; v <= y + kHalf; ++v) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int u = x - kHalf; u <= x + kHalf; ++u) sum += patch[k++] = row[u];
  }
  const int mean = (sum + kSide * kSide / 2) / (kSide * kSide);
  for (int& value : patch) value -= mean;
  return true;
}

int Difference(const Patch& a, const Patch& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoRig& rig, const StereoTrackerConfig& config)
    : rig_(rig), config_(config), X_RL_(rig.X_LR.Inverse()) {}

std::optional<Vec2> StereoMatcher::SearchEpipolarLine(const Pyramid& left, const Pyramid& right,
                                                      const Vec2& pixel) const {
  Patch wanted, seen;
  const auto half = [](double full) { return static_cast<int>(std::lround(0.5 * full)); };
  if (!ReadPatch(left.image(1), half(pixel.x()), half(pixel.y()), wanted)) return std::nullopt;

  // Steps of equal inverse depth are steps of nearly equal length on the line; one half-resolution pixel each.
  const Vec3 ray = Normalise(rig_.left, pixel).homogeneous();
  const double nearest = 1.0 / config_.min_stereo_depth;
  const auto at = [&](double inverse_depth) { return Vec3(X_RL_.q * ray + inverse_depth * X_RL_.p); };
  const Vec2 far_end = Project(rig_.right, at(0.0)), near_end = Project(rig_.right, at(nearest));
  const int steps = std::max(2, static_cast<int>(std::ceil(0.5 * (near_end - far_end).norm())));
  struct Step {
    Vec2 pixel;
    int cost;
  };
  std::vector<Step> line;
  for (int i = -1; i <= steps; ++i) {  // one step beyond infinity: the calibration is not exact
    const Vec2 p = far_end + (near_end - far_end) * (static_cast<double>(i) / steps);
    if (ReadPatch(right.image(1), half(p.x()), half(p.y()), seen)) line.push_back({p, Difference(wanted, seen)});
  }
  if (line.size() < 2) return std::nullopt;
  const auto best =
      std::min_element(line.begin(), line.end(), [](const Step& a, const Step& b) { return a.cost < b.cost; });
  int elsewhere = std::numeric_limits<int>::max();
  for (const Step& step : line) {
    if ((step.pixel - best->pixel).norm() > 5.0) elsewhere = std::min(elsewhere, step.cost);
  }
  int contrast = 0;
  for (const int value : wanted) contrast += std::abs(value);
  const bool good = best->cost < kMaxMisfit * contrast + kNoise * kSide * kSide;
  if (!good || best->cost > kUnique * elsewhere) return std::nullopt;
  return best->pixel;
}

std::optional<StereoMatcher::Match> StereoMatcher::Accept(const Vec2& left_pixel,
                                                          const cv::Point2f& right_pixel) const {
  Match match;
  match.pixel = {right_pixel.x, right_pixel.y};
  match.left = Normalise(rig_.left, left_pixel);
  match.right = Normalise(rig_.right, match.pixel);
  // Distance to the epipolar line l = E x, E = [t]× R.
  const Vec3 line = X_RL_.p.cross(X_RL_.q * Vec3(match.left.homogeneous()));
  const double error = std::abs(line.dot(Vec3(match.right.homogeneous()))) / line.head<2>().norm() * rig_.right.fx;
  if (error > config_.max_epipolar_error) return std::nullopt;
  match.depth = TriangulatedDepth(rig_.X_LR, match.left, match.right);
  if (match.depth > 0 && match.depth < 0.8 * config_.min_stereo_depth) return std::nullopt;
  if (match.depth <= 0) {  // beyond infinity by no more than noise and calibration allow
    const Vec2 infinity = Project(rig_.right, X_RL_.q * Vec3(match.left.homogeneous()));
    if ((match.pixel - infinity).norm() > 1.5) return std::nullopt;
  }
  return match;
}

std::vector<std::optional<StereoMatcher::Match>> StereoMatcher::Find(const Pyramid& left, const Pyramid& right,
                                                                     const std::vector<Query>& queries) const {
  std::vector<std::optional<Match>> matches(queries.size());
  // Known and searched points apart: the latter are worth a check back.
  for (const bool known : {true, false}) {
    std::vector<std::size_t> index;
    std::vector<cv::Point2f> from, guess;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Query& q = queries[i];
      if (q.depth.has_value() != known) continue;
      std::optional<Vec2> place;
      if (known) {
        const Vec3 p_R = X_RL_ * Vec3(*q.depth * Normalise(rig_.left, q.pixel).homogeneous());
        if (p_R.z() > 0.05) place = Project(rig_.right, p_R);
      } else {
        place = SearchEpipolarLine(left, right, q.pixel);
      }
      if (!place || !Inside(rig_.right, *place, 1.0)) continue;
      index.push_back(i);
      from.emplace_back(static_cast<float>(q.pixel.x()), static_cast<float>(q.pixel.y()));
      guess.emplace_back(static_cast<float>(place->x()), static_cast<float>(place->y()));
    }
    const std::vector<Flow> flow = FollowPoints(left, right, from, guess, 1, !known, config_);
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (!flow[k].found || !Inside(rig_.right, {flow[k].to.x, flow[k].to.y}, 1.0)) continue;
      matches[index[k]] = Accept(queries[index[k]].pixel, flow[k].to);
    }
  }
  return matches;
}

}  // namespace alula::stack::features
