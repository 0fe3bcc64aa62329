#include "stack/slam/bundle_adjustment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "stack/slam/internal/bundle_residuals.h"
#include "stack/slam/internal/reduced_system.h"

namespace alula::stack::slam {

using base::Mat3;
using base::Mat6;
using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;

namespace {

constexpr double kBehind = 100.0;  // σ that a point counts which has come behind an eye
using Mat63 = Eigen::Matrix<double, 6, 3>;

/// ρ of |r|² with width k (Huber), and the weight that it gives.
double Huber(double square, double k, double& weight) {
  const double norm = std::sqrt(square);
  weight = norm > k ? k / norm : 1.0;
  return norm > k ? 2.0 * k * norm - k * k : square;
}

/// The problem while it is being solved.
class Adjuster {
 public:
  Adjuster(Bundle& bundle, const BundleOptions& options) : bundle_(bundle), options_(options) {
    for (const BundlePose& pose : bundle_.poses) column_.push_back(pose.fixed ? -1 : free_++);
    views_.resize(bundle_.poses.size());
  }

  BundleSummary Run() {
    BundleSummary summary;
    double cost = Cost();
    summary.initial_cost = summary.cost = cost;
    ReducedSystem system(free_);
    double lambda = 1e-4, growth = 2.0;
    for (int i = 0; i < options_.iterations; ++i) {
      Linearise();
      bool accepted = false;
      for (int attempt = 0; attempt < kAttempts && !accepted; ++attempt) {
        const double promised = Step(system, lambda);
        const std::vector<Transform> poses = Poses();
        const std::vector<Vec3> points = Points();
        if (promised > 0.0) {
          Apply();
          const double tried = Cost();
          if (std::isfinite(tried) && tried < cost) {
            const double gain = (cost - tried) / promised;
            lambda *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
            lambda = std::max(lambda, 1e-9);
            growth = 2.0;
            accepted = true;
            const bool settled = cost - tried < options_.tolerance * cost;
            cost = tried;
            ++summary.iterations;
            if (settled) i = options_.iterations;
            continue;
          }
        }
        Restore(poses, points);
        lambda *= growth;
        growth *= 2.0;
      }
      if (!accepted) break;
    }
    summary.cost = cost;
    return summary;
  }

 private:
  static constexpr int kAttempts = 6;

  /// A point's part of the normal equations.
  struct PointBlock {
    Mat3 H = Mat3::Zero();
    Vec3 b = Vec3::Zero();
    std::size_t first = 0, count = 0;  // of couplings_
    Mat3 inverse = Mat3::Zero();
  };
  struct Coupling {
    int column = 0;
    Mat63 H;
  };

  void RefreshViews() {
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i] = ViewFrom(bundle_.poses[i].X_MB, bundle_.eyes);
  }

  double Cost() {
    RefreshViews();
    double sum = 0.0, weight = 0.0;
    Vec3 r;
    for (const BundlePoint& point : bundle_.points) {
      for (const Sight& sight : point.sights) {
        const bool seen = SightResidual(views_[static_cast<std::size_t>(sight.pose)], sight, point.p_M, r, nullptr);
        sum += Huber(seen ? r.squaredNorm() : kBehind * kBehind, options_.huber, weight);
      }
    }
    for (const RelativeMotion& m : bundle_.motions) sum += MotionResidual(Pose(m.from), Pose(m.to), m).squaredNorm();
    for (const Vertical& v : bundle_.verticals) sum += VerticalResidual(Pose(v.pose), v).squaredNorm();
    return 0.5 * sum;
  }

  const Transform& Pose(int i) const { return bundle_.poses[static_cast<std::size_t>(i)].X_MB; }

  void Linearise() {
    H_poses_.assign(static_cast<std::size_t>(free_), Mat6::Zero());
    b_poses_.assign(static_cast<std::size_t>(free_), Vec6::Zero());
    couplings_.clear();
    blocks_.clear();
    for (const BundlePoint& point : bundle_.points) AddPoint(point);
    between_.clear();
    for (const RelativeMotion& motion : bundle_.motions) AddMotion(motion);
    for (const Vertical& vertical : bundle_.verticals) AddVertical(vertical);
  }

  void AddPoint(const BundlePoint& point) {
    PointBlock block;
    block.first = couplings_.size();
    Vec3 r;
    Mat3 by_L;
    for (const Sight& sight : point.sights) {
      const View& view = views_[static_cast<std::size_t>(sight.pose)];
      if (!SightResidual(view, sight, point.p_M, r, &by_L)) continue;
      double weight = 1.0;
      Huber(r.squaredNorm(), options_.huber, weight);
      const Mat3 by_M = by_L * view.R_LM;
      block.H += weight * by_M.transpose() * by_M;
      block.b += weight * by_M.transpose() * r;
      const int column = column_[static_cast<std::size_t>(sight.pose)];
      if (column < 0) continue;
      const Mat36 by_pose = ByPose(by_L, view, Pose(sight.pose), point.p_M);
      const auto c = static_cast<std::size_t>(column);
      H_poses_[c].triangularView<Eigen::Upper>() += weight * by_pose.transpose() * by_pose;
      b_poses_[c] += weight * by_pose.transpose() * r;
      if (!point.fixed) couplings_.push_back({column, weight * by_pose.transpose() * by_M});
    }
    block.count = couplings_.size() - block.first;
    const auto first = couplings_.begin() + static_cast<std::ptrdiff_t>(block.first);
    std::sort(first, couplings_.end(), [](const Coupling& a, const Coupling& b) { return a.column < b.column; });
    blocks_.push_back(block);
  }

  void AddMotion(const RelativeMotion& m) {
    const Transform &F = Pose(m.from), &T = Pose(m.to);
    const Vec6 r = MotionResidual(F, T, m);
    Mat6 by_F, by_T;
    MotionJacobians(F, T, m, by_F, by_T);
    const int f = column_[static_cast<std::size_t>(m.from)], t = column_[static_cast<std::size_t>(m.to)];
    if (f >= 0) {
      H_poses_[static_cast<std::size_t>(f)] += by_F.transpose() * by_F;
      b_poses_[static_cast<std::size_t>(f)] += by_F.transpose() * r;
    }
    if (t >= 0) {
      H_poses_[static_cast<std::size_t>(t)] += by_T.transpose() * by_T;
      b_poses_[static_cast<std::size_t>(t)] += by_T.transpose() * r;
    }
    if (f >= 0 && t >= 0) {
      const Mat6 cross = by_F.transpose() * by_T;
      between_.push_back(f < t ? Between{f, t, cross} : Between{t, f, cross.transpose()});
    }
  }

  void AddVertical(const Vertical& v) {
    const int column = column_[static_cast<std::size_t>(v.pose)];
    if (column < 0) return;
    const Mat3 J = VerticalJacobian(Pose(v.pose), v);
    const auto c = static_cast<std::size_t>(column);
    H_poses_[c].bottomRightCorner<3, 3>() += J.transpose() * J;
    b_poses_[c].tail<3>() += J.transpose() * VerticalResidual(Pose(v.pose), v);
  }

  /// Solves the damped system; the decrease of cost that the linear model promises, 0 where it cannot be solved.
  double Step(ReducedSystem& system, double lambda) {
    system.SetZero();
    for (int i = 0; i < free_; ++i) {
      system.At(i, i) += H_poses_[static_cast<std::size_t>(i)];
      system.b().segment<6>(6 * i) += b_poses_[static_cast<std::size_t>(i)];
      system.At(i, i).diagonal() += lambda * H_poses_[static_cast<std::size_t>(i)].diagonal();
    }
    for (const Between& b : between_) system.At(b.i, b.j) += b.H;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (!bundle_.points[k].fixed) Eliminate(blocks_[k], lambda, system);
    }
    delta_points_.resize(blocks_.size());
    if (free_ > 0 && !system.Solve(0.0, delta_)) return 0.0;
    if (free_ == 0) delta_.resize(0);
    double promised = 0.0;  // ½ δᵀ(λ D δ − b)
    for (int i = 0; i < free_; ++i) {
      const Vec6 d = delta_.segment<6>(6 * i);
      const auto c = static_cast<std::size_t>(i);
      promised += 0.5 * d.dot(lambda * H_poses_[c].diagonal().cwiseProduct(d) - b_poses_[c]);
    }
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      delta_points_[k].setZero();
      if (bundle_.points[k].fixed) continue;
      const PointBlock& block = blocks_[k];
      Vec3 right = -block.b;
      for (std::size_t i = 0; i < block.count; ++i) {
        const Coupling& c = couplings_[block.first + i];
        right -= c.H.transpose() * delta_.segment<6>(6 * c.column);
      }
      const Vec3 d = block.inverse * right;
      delta_points_[k] = d;
      promised += 0.5 * d.dot(lambda * block.H.diagonal().cwiseProduct(d) - block.b);
    }
    return promised;
  }

  void Eliminate(PointBlock& block, double lambda, ReducedSystem& system) {
    Mat3 H = block.H;
    H.diagonal() += lambda * block.H.diagonal();
    H.diagonal().array() += 1e-9 * block.H.trace() + 1e-12;  // a depth that nothing tells stays where it is
    block.inverse = H.inverse();
    const Vec3 solved = block.inverse * block.b;
    for (std::size_t i = 0; i < block.count; ++i) {
      const Coupling& a = couplings_[block.first + i];
      const Mat63 K = a.H * block.inverse;
      system.b().segment<6>(6 * a.column) -= a.H * solved;
      for (std::size_t j = i; j < block.count; ++j) {
        const Coupling& c = couplings_[block.first + j];
        system.At(a.column, c.column).noalias() -= K * c.H.transpose();
      }
    }
  }

  void Apply() {
    for (std::size_t i = 0; i < bundle_.poses.size(); ++i) {
      if (column_[i] < 0) continue;
      const Vec6 d = delta_.segment<6>(6 * column_[i]);
      Transform& X = bundle_.poses[i].X_MB;
      X = {(X.q * base::Exp(d.tail<3>())).normalized(), X.p + d.head<3>()};
    }
    for (std::size_t k = 0; k < bundle_.points.size(); ++k) bundle_.points[k].p_M += delta_points_[k];
  }
  std::vector<Transform> Poses() const {
    std::vector<Transform> poses;
    for (const BundlePose& pose : bundle_.poses) poses.push_back(pose.X_MB);
    return poses;
  }
  std::vector<Vec3> Points() const {
    std::vector<Vec3> points;
    for (const BundlePoint& point : bundle_.points) points.push_back(point.p_M);
    return points;
  }
  void Restore(const std::vector<Transform>& poses, const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < poses.size(); ++i) bundle_.poses[i].X_MB = poses[i];
    for (std::size_t i = 0; i < points.size(); ++i) bundle_.points[i].p_M = points[i];
    RefreshViews();
  }

  struct Between {
    int i, j;
    Mat6 H;
  };

  Bundle& bundle_;
  BundleOptions options_;
  std::vector<int> column_;  // of a pose; −1: fixed
  int free_ = 0;
  std::vector<View> views_;
  std::vector<Mat6> H_poses_;
  std::vector<Vec6> b_poses_;
  std::vector<PointBlock> blocks_;
  std::vector<Coupling> couplings_;
  std::vector<Between> between_;
  Eigen::VectorXd delta_;
  std::vector<Vec3> delta_points_;
};

}  // namespace

BundleSummary Adjust(Bundle& bundle, const BundleOptions& options) { return Adjuster(bundle, options).Run(); }

}  // namespace alula::stack::slam
