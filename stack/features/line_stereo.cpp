#include "stack/features/line_stereo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace alula::stack::features {
namespace {

using base::Mat3;
using base::Vec2;
using base::Vec3;

using Cost = Eigen::Vector4d;

/// Rotations of both cameras into a common orientation whose x axis is the baseline: rows agree there.
struct Rectified {
  Mat3 R_CL, R_CR;  // left and right camera's axes into the common ones
  double baseline = 0.0;
};

Rectified Rectify(const StereoRig& rig) {
  Rectified r;
  r.baseline = rig.X_LR.p.norm();
  const Vec3 x = rig.X_LR.p / r.baseline;
  const Vec3 forward = (Vec3::UnitZ() + rig.X_LR.q * Vec3::UnitZ()).normalized();
  const Vec3 y = forward.cross(x).normalized();
  Mat3 R_LC;
  R_LC << x, y, x.cross(y);
  r.R_CL = R_LC.transpose();
  r.R_CR = r.R_CL * rig.X_LR.R();
  return r;
}

/// A segment in the common orientation, normalised coordinates, its ends by row.
struct RectifiedLine {
  Vec2 a, b;
  double top = 0.0, bottom = 0.0;

  double AtRow(double y) const { return a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()); }
};

std::optional<RectifiedLine> Seen(const CameraIntrinsics& camera, const Mat3& R, const LineSegment& line) {
  RectifiedLine seen;
  for (const auto& [pixel, out] : {std::pair{line.a, &seen.a}, std::pair{line.b, &seen.b}}) {
    const Vec3 ray = R * Vec3(Normalise(camera, pixel).homogeneous());
    if (ray.z() < 0.1) return std::nullopt;
    *out = ray.head<2>() / ray.z();
  }
  seen.top = std::min(seen.a.y(), seen.b.y());
  seen.bottom = std::max(seen.a.y(), seen.b.y());
  return seen;
}

double Sample(const Image& image, const Vec2& p) {
  const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
  const double fu = p.x() - u, fv = p.y() - v;
  const std::uint8_t *top = image.Row(v) + u, *low = image.Row(v + 1) + u;
  return (1 - fv) * ((1 - fu) * top[0] + fu * top[1]) + fv * ((1 - fu) * low[0] + fu * low[1]);
}

/// Normalised cross-correlation of upright patches; none at an edge of the image or without contrast.
std::optional<double> Likeness(const Image& a, const Vec2& at_a, const Image& b, const Vec2& at_b, int side) {
  const double half = 0.5 * (side - 1);
  const auto inside = [half](const Image& image, const Vec2& p) {
    return p.x() >= half + 1 && p.y() >= half + 1 && p.x() < image.width - half - 2 && p.y() < image.height - half - 2;
  };
  if (!inside(a, at_a) || !inside(b, at_b)) return std::nullopt;
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Vec2 d(j - half, i - half);
      const double x = Sample(a, at_a + d), y = Sample(b, at_b + d);
      sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
    }
  }
  const double n = side * side, va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  if (va < n || vb < n) return std::nullopt;
  return (sab - sa * sb / n) / std::sqrt(va * vb);
}

/// The non-negative w that minimises ½ |Q w − t|² + λ |w|₁, by coordinate descent.
Eigen::VectorXd SparseWeights(const Eigen::Matrix<double, 4, Eigen::Dynamic>& Q, const Cost& target, double lambda) {
  constexpr int kRounds = 50;
  Eigen::VectorXd w = Eigen::VectorXd::Zero(Q.cols());
  Cost rest = target;  // t − Q w
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0;
    for (Eigen::Index j = 0; j < Q.cols(); ++j) {
      const double norm = Q.col(j).squaredNorm();
      const double next = std::max(0.0, (Q.col(j).dot(rest) + norm * w[j] - lambda) / norm);
      rest -= (next - w[j]) * Q.col(j);
      moved = std::max(moved, std::abs(next - w[j]));
      w[j] = next;
    }
    if (moved < 1e-6) break;
  }
  return w;
}

}  // namespace

std::vector<StereoLine> MatchLines(const StereoRig& rig, const Image& left, const Image& right,
                                   const std::vector<LineSegment>& left_lines,
                                   const std::vector<LineSegment>& right_lines, const LineStereoConfig& config) {
  const Rectified rectified = Rectify(rig);
  const double largest = rectified.baseline / config.min_depth;  // disparity
  std::vector<std::optional<RectifiedLine>> right_seen;
  for (const LineSegment& line : right_lines) right_seen.push_back(Seen(rig.right, rectified.R_CR, line));
  std::vector<StereoLine> matches;
  for (std::size_t i = 0; i < left_lines.size(); ++i) {
    const std::optional<RectifiedLine> l = Seen(rig.left, rectified.R_CL, left_lines[i]);
    if (!l) continue;
    const Vec2 way = l->b - l->a;
    if (std::abs(way.y()) < config.min_slope * way.norm()) continue;
    std::vector<int> candidates;
    std::vector<Cost> costs;
    for (std::size_t j = 0; j < right_lines.size(); ++j) {
      const std::optional<RectifiedLine>& r = right_seen[j];
      if (!r) continue;
      const Vec2 other = r->b - r->a;
      const double cosine = way.dot(other) / (way.norm() * other.norm());
      if (cosine < std::cos(config.max_angle) || std::abs(other.y()) < 0.5 * config.min_slope * other.norm()) continue;
      const double top = std::max(l->top, r->top), bottom = std::min(l->bottom, r->bottom);
      const double rows = l->bottom - l->top, shared = (bottom - top) / rows;
      if (shared < config.min_overlap) continue;
      const double at_a = l->a.x() - r->AtRow(l->a.y()), at_b = l->b.x() - r->AtRow(l->b.y());
      if (at_a <= 0.0 || at_b <= 0.0 || at_a > largest || at_b > largest) continue;
      // The middles of the common rows.
      const double row = 0.5 * (top + bottom);
      const Vec3 ray_l = rectified.R_CL.transpose() * Vec3(l->AtRow(row), row, 1.0);
      const Vec3 ray_r = rectified.R_CR.transpose() * Vec3(r->AtRow(row), row, 1.0);
      const std::optional<double> likeness =
          Likeness(left, Project(rig.left, ray_l), right, Project(rig.right, ray_r), config.patch);
      if (!likeness || *likeness < config.min_likeness) continue;
      const double ratio = std::min(rows, r->bottom - r->top) / std::max(rows, r->bottom - r->top);
      candidates.push_back(static_cast<int>(j));
      costs.emplace_back(1.0 - cosine, 0.5 * (at_a + at_b) / largest, *likeness, ratio);
    }
    if (candidates.empty()) continue;
    Eigen::Matrix<double, 4, Eigen::Dynamic> Q(4, static_cast<Eigen::Index>(costs.size()));
    for (std::size_t k = 0; k < costs.size(); ++k) Q.col(static_cast<Eigen::Index>(k)) = costs[k];
    const Eigen::VectorXd w = SparseWeights(Q, Cost(0, 0, 1, 1), config.sparsity);
    Eigen::Index best = 0;
    const double sum = w.sum(), most = w.maxCoeff(&best);
    if (sum <= 0.0 || most < config.min_weight * sum) continue;
    const int j = candidates[static_cast<std::size_t>(best)];
    const RectifiedLine& r = *right_seen[static_cast<std::size_t>(j)];
    StereoLine match{static_cast<int>(i), j, {}, most / sum};
    for (const auto& [end, out] : {std::pair{l->a, &match.ends_L[0]}, std::pair{l->b, &match.ends_L[1]}}) {
      const double depth = rectified.baseline / (end.x() - r.AtRow(end.y()));
      *out = rectified.R_CL.transpose() * Vec3(depth * end.homogeneous());
    }
    matches.push_back(match);
  }
  return matches;
}

}  // namespace alula::stack::features
