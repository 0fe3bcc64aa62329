#include "stack/features/pose_ransac.h"

#include <Eigen/Cholesky>
#include <array>
#include <optional>
#include <utility>

namespace alula::stack::features {
namespace {

using base::Mat6;
using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;

constexpr double kNearest = 0.05;  // m

PoseResult Judge(const std::vector<PointAndRay>& points, const Transform& X_TS, double gate) {
  PoseResult result{X_TS, std::vector<bool>(points.size(), false), 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = X_TS * points[i].p;
    if (p.z() < kNearest || (p.head<2>() / p.z() - points[i].seen).squaredNorm() > gate * gate) continue;
    result.inlier[i] = true;
    ++result.inliers;
  }
  return result;
}

/// One step of Gauss-Newton over those who agree: X ← {Exp(δθ) q, p + δp}.
std::optional<Transform> Step(const std::vector<PointAndRay>& points, const PoseResult& from, double kernel) {
  Mat6 H = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!from.inlier[i]) continue;
    const Vec3 turned = from.X_TS.q * points[i].p, p = turned + from.X_TS.p;
    if (p.z() < kNearest) continue;
    const Vec2 projected = p.head<2>() / p.z(), r = projected - points[i].seen;
    Eigen::Matrix<double, 2, 3> by_p;
    by_p << 1, 0, -projected.x(), 0, 1, -projected.y();
    by_p /= p.z();
    Eigen::Matrix<double, 2, 6> J;
    J << by_p, -by_p * base::Hat(turned);
    const double weight = r.norm() > kernel ? kernel / r.norm() : 1.0;
    H += weight * J.transpose() * J;
    b += weight * J.transpose() * r;
  }
  const Vec6 step = H.ldlt().solve(-b);
  if (!step.allFinite()) return std::nullopt;
  return Transform{(base::Exp(Vec3(step.tail<3>())) * from.X_TS.q).normalized(), from.X_TS.p + step.head<3>()};
}

}  // namespace

PoseResult FindPose(const std::vector<PointAndRay>& points, const Transform& guess, double gate, int trials,
                    base::RandomStream& random) {
  constexpr int kRounds = 4;
  constexpr double kAllAgree = 0.95;  // share at which chance has nothing to add
  PoseResult best = Judge(points, guess, gate);
  const auto polish = [&](PoseResult result) {
    for (int round = 0; round < kRounds && result.inliers >= 4; ++round) {
      const std::optional<Transform> moved = Step(points, result, gate / 3.0);
      if (!moved) break;
      PoseResult next = Judge(points, *moved, gate);
      if (next.inliers < result.inliers) break;
      result = std::move(next);
    }
    return result;
  };
  best = polish(std::move(best));
  for (int trial = 0; trial < trials && points.size() >= 4; ++trial) {
    if (best.inliers > kAllAgree * static_cast<double>(points.size())) break;
    std::array<PointAndRay, 3> sample;
    std::array<std::size_t, 3> chosen{};
    for (std::size_t k = 0; k < 3; ++k) {
      chosen[k] = random.Index(points.size());
      sample[k] = points[chosen[k]];
    }
    if (chosen[0] == chosen[1] || chosen[1] == chosen[2] || chosen[0] == chosen[2]) continue;
    for (const Transform& X_TS : SolveThreePoints(sample)) {
      PoseResult candidate = Judge(points, X_TS, gate);
      if (candidate.inliers > best.inliers) best = std::move(candidate);
    }
  }
  return polish(std::move(best));
}

}  // namespace alula::stack::features
