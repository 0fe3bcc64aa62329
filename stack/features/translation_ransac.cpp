#include "stack/features/translation_ransac.h"

#include <Eigen/Cholesky>

namespace alula::stack::features {
namespace {

using base::Mat3;
using base::Vec2;
using base::Vec3;

/// Normal equations of seen.x (p.z + t.z) = p.x + t.x and its twin in y.
struct Linear {
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  void Add(const TurnedPoint& point) {
    // Divided by the depth, so that rows are reprojection errors and far points do not weigh more.
    const double w = 1.0 / std::max(0.1, point.p.z());
    for (int axis = 0; axis < 2; ++axis) {
      Vec3 row = Vec3::Zero();
      row[axis] = w;
      row.z() = -w * point.seen[axis];
      A += row * row.transpose();
      b += row * w * (point.seen[axis] * point.p.z() - point.p[axis]);
    }
  }
  Vec3 Solve() const { return (A + 1e-12 * A.trace() * Mat3::Identity()).ldlt().solve(b); }
};

TranslationResult Judge(const std::vector<TurnedPoint>& points, const Vec3& t, double gate) {
  TranslationResult result{t, std::vector<bool>(points.size(), false), 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i].p + t;
    if (p.z() < 0.05 || (p.head<2>() / p.z() - points[i].seen).squaredNorm() > gate * gate) continue;
    result.inlier[i] = true;
    ++result.inliers;
  }
  return result;
}

}  // namespace

TranslationResult FindTranslation(const std::vector<TurnedPoint>& points, const Vec3& guess, double gate, int trials,
                                  base::RandomStream& random) {
  TranslationResult best = Judge(points, guess, gate);
  if (points.size() < 2) return best;
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t first = random.Index(points.size());
    const std::size_t second = random.Index(points.size());
    if (first == second) continue;
    Linear pair;
    pair.Add(points[first]);
    pair.Add(points[second]);
    const Vec3 t = pair.Solve();
    if (!t.allFinite()) continue;
    TranslationResult candidate = Judge(points, t, gate);
    if (candidate.inliers > best.inliers) best = std::move(candidate);
  }
  // Once more with all who agree.
  Linear all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (best.inlier[i]) all.Add(points[i]);
  }
  if (best.inliers >= 3) {
    TranslationResult refined = Judge(points, all.Solve(), gate);
    if (refined.inliers >= best.inliers) best = std::move(refined);
  }
  return best;
}

}  // namespace alula::stack::features
