#include "stack/slam/relative_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/random.h"
#include "stack/features/keypoint_grid.h"
#include "stack/features/pose_solvers.h"
#include "stack/slam/internal/place_residual.h"

namespace alula::stack::slam {
namespace {

using base::Mat3;
using base::Mat6;
using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;
using features::PointAndRay;
using internal::PlaceResidual;

constexpr double kHuber = 1.5;  // σ

const PlacePoint& At(const PlaceView& view, int i) { return view.points[static_cast<std::size_t>(i)]; }

/// The two views and what is known of them.
class Problem {
 public:
  Problem(const PlaceView& a, const PlaceView& b, const RelativePoseConfig& config)
      : a_(a), b_(b), config_(config), gravity_(config.use_gravity && a.up_C && b.up_C) {}

  std::vector<PointPair> Match() const {
    std::vector<features::Descriptor> of_a, of_b;
    for (const PlacePoint& p : a_.points) of_a.push_back(p.descriptor);
    for (const PlacePoint& p : b_.points) of_b.push_back(p.descriptor);
    std::vector<PointPair> pairs;
    for (const features::DescriptorMatch& m :
         features::MatchDescriptors(of_a, of_b, {config_.max_distance, config_.ratio, true})) {
      if (At(a_, m.a).p_C || At(b_, m.b).p_C) pairs.push_back({m.a, m.b});
    }
    return pairs;
  }

  std::optional<PlaceResidual> Residual(const PointPair& pair, const Transform& X_BA) const {
    return internal::ResidualOf(a_, At(a_, pair.a), b_, At(b_, pair.b), X_BA, config_);
  }

  std::vector<PointPair> Inliers(const std::vector<PointPair>& pairs, const Transform& X_BA) const {
    std::vector<PointPair> inliers;
    for (const PointPair& pair : pairs) {
      const auto residual = Residual(pair, X_BA);
      if (residual && internal::Fits(*residual, config_)) inliers.push_back(pair);
    }
    return inliers;
  }

  /// The best of many poses from few matches: where most fit.
  std::vector<PointPair> Sample(const std::vector<PointPair>& pairs, base::RandomStream& random, Transform& X_BA) const;

  /// Gauss–Newton from X_BA; the information matrix at its end, by (δt_BA, δθ).
  Mat6 Refine(const std::vector<PointPair>& pairs, Transform& X_BA) const;

  /// Matches of all points by where they should be seen: of those near it the most alike, each taken once.
  std::vector<PointPair> Search(const Transform& X_BA) const;

  /// Inliers as a share of the points of A, or if fewer of B, that the other view should show.
  double SeenShare(const std::vector<PointPair>& inliers, const Transform& X_BA) const;

  /// 1σ of their places across the narrow direction, of the focal length, in the view where that is less.
  double SpreadOf(const std::vector<PointPair>& inliers) const;

 private:
  std::vector<Transform> SolveFrom(const std::vector<PointPair>& sample, bool from_a) const;
  std::vector<PointPair> SearchFrom(const PlaceView& from, const PlaceView& to, const Transform& X, bool from_a) const;
  void AddGravity(const Transform& X_BA, Mat6& information, Vec6& gradient) const;

  const PlaceView& a_;
  const PlaceView& b_;
  const RelativePoseConfig& config_;
  bool gravity_;
};

std::vector<Transform> Problem::SolveFrom(const std::vector<PointPair>& sample, bool from_a) const {
  std::array<PointAndRay, 3> points;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const PlacePoint &a = At(a_, sample[i].a), &b = At(b_, sample[i].b);
    points[i] = from_a ? PointAndRay{*a.p_C, b.normalised} : PointAndRay{*b.p_C, a.normalised};
  }
  std::vector<Transform> poses;
  if (gravity_) {
    poses =
        features::SolveTwoPoints({points[0], points[1]}, from_a ? *a_.up_C : *b_.up_C, from_a ? *b_.up_C : *a_.up_C);
  } else {
    poses = features::SolveThreePoints(points);
  }
  if (!from_a) {
    for (Transform& X : poses) X = X.Inverse();
  }
  return poses;
}

std::vector<PointPair> Problem::Sample(const std::vector<PointPair>& pairs, base::RandomStream& random,
                                       Transform& X_BA) const {
  std::vector<PointPair> from_a, from_b, best;
  for (const PointPair& pair : pairs) {
    if (At(a_, pair.a).p_C) from_a.push_back(pair);
    if (At(b_, pair.b).p_C) from_b.push_back(pair);
  }
  const std::size_t needed = gravity_ ? 2 : 3;
  int trials = config_.trials;
  for (int trial = 0; trial < trials; ++trial) {
    const bool use_a = random.Index(from_a.size() + from_b.size()) < from_a.size();
    const std::vector<PointPair>& pool = use_a ? from_a : from_b;
    if (pool.size() < needed) continue;
    std::vector<PointPair> sample;
    std::set<std::uint64_t> drawn;
    while (drawn.size() < needed) {
      if (const std::uint64_t i = random.Index(pool.size()); drawn.insert(i).second) sample.push_back(pool[i]);
    }
    for (const Transform& X : SolveFrom(sample, use_a)) {
      std::vector<PointPair> inliers = Inliers(pairs, X);
      if (inliers.size() <= best.size()) continue;
      best = std::move(inliers);
      X_BA = X;
      // Trials after which a sample without a wrong match has been drawn with 99.9 %.
      const double share = static_cast<double>(best.size()) / static_cast<double>(pairs.size());
      const double miss = 1.0 - std::pow(share, static_cast<double>(needed));
      if (miss <= 0.0) return best;
      trials = std::min<int>(config_.trials, static_cast<int>(std::ceil(std::log(1e-3) / std::log(miss))));
    }
  }
  return best;
}

void Problem::AddGravity(const Transform& X_BA, Mat6& information, Vec6& gradient) const {
  // r = R Exp(δθ) up_A − up_B, 1σ √2 times that of one view.
  const Vec3 r = X_BA.q * *a_.up_C - *b_.up_C;
  const Mat3 jacobian = -X_BA.R() * base::Hat(*a_.up_C);
  const double weight = 1.0 / (2.0 * config_.gravity_sigma * config_.gravity_sigma);
  information.bottomRightCorner<3, 3>() += weight * jacobian.transpose() * jacobian;
  gradient.tail<3>() += weight * jacobian.transpose() * r;
}

Mat6 Problem::Refine(const std::vector<PointPair>& pairs, Transform& X_BA) const {
  constexpr int kIterations = 6;
  Mat6 information;
  for (int i = 0; i < kIterations; ++i) {
    information.setZero();
    Vec6 gradient = Vec6::Zero();
    for (const PointPair& pair : pairs) {
      const auto residual = Residual(pair, X_BA);
      if (!residual) continue;
      const double sigmas = std::sqrt(residual->squared);
      const double weight = sigmas > kHuber ? kHuber / sigmas : 1.0;
      const Eigen::Matrix<double, 6, 3> weighted = weight * residual->jacobian.transpose() * residual->information;
      information += weighted * residual->jacobian;
      gradient += weighted * residual->r;
    }
    if (gravity_) AddGravity(X_BA, information, gradient);
    const Vec6 step = -information.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    X_BA.p += step.head<3>();
    X_BA.q = (X_BA.q * base::Exp(step.tail<3>())).normalized();
    if (step.norm() < 1e-8) break;
  }
  return information;
}

std::vector<PointPair> Problem::SearchFrom(const PlaceView& from, const PlaceView& to, const Transform& X,
                                           bool from_a) const {
  // Undistorted pixels, the optical axis in the middle of two focal lengths.
  const auto place = [&to](const Vec2& normalised) { return Vec2(to.focal * (normalised + Vec2::Constant(1.0))); };
  std::vector<Vec2> places;
  for (const PlacePoint& p : to.points) places.push_back(place(p.normalised));
  const int side = static_cast<int>(2 * to.focal);
  const features::KeypointGrid grid(places, side, side, 2 * config_.search_radius);
  struct Claim {
    int by = -1;
    int distance = 0;
  };
  std::vector<Claim> claims(to.points.size());
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const PlacePoint& point = from.points[i];
    if (!point.p_C) continue;
    const Vec3 p = X * *point.p_C;
    if (p.z() < 0.05) continue;
    Claim best{-1, config_.search_distance + 1};
    for (const int j : grid.Around(place(p.head<2>() / p.z()), config_.search_radius)) {
      const int distance = features::HammingDistance(point.descriptor, At(to, j).descriptor);
      if (distance < best.distance) best = {j, distance};
    }
    if (best.by < 0) continue;
    Claim& claim = claims[static_cast<std::size_t>(best.by)];
    if (claim.by < 0 || best.distance < claim.distance) claim = {static_cast<int>(i), best.distance};
  }
  std::vector<PointPair> pairs;
  for (std::size_t j = 0; j < claims.size(); ++j) {
    if (claims[j].by < 0) continue;
    pairs.push_back(from_a ? PointPair{claims[j].by, static_cast<int>(j)}
                           : PointPair{static_cast<int>(j), claims[j].by});
  }
  return pairs;
}

std::vector<PointPair> Problem::Search(const Transform& X_BA) const {
  std::vector<PointPair> pairs = SearchFrom(a_, b_, X_BA, true);
  std::vector<bool> a_taken(a_.points.size(), false), b_taken(b_.points.size(), false);
  for (const PointPair& p : pairs) {
    a_taken[static_cast<std::size_t>(p.a)] = true;
    b_taken[static_cast<std::size_t>(p.b)] = true;
  }
  for (const PointPair& p : SearchFrom(b_, a_, X_BA.Inverse(), false)) {
    if (!a_taken[static_cast<std::size_t>(p.a)] && !b_taken[static_cast<std::size_t>(p.b)]) pairs.push_back(p);
  }
  return pairs;
}

double Problem::SeenShare(const std::vector<PointPair>& inliers, const Transform& X_BA) const {
  // A view shows at least the box of its own keypoints.
  const auto expected = [](const PlaceView& from, const PlaceView& to, const Transform& X) {
    Vec2 low = Vec2::Constant(1e9), high = -low;
    for (const PlacePoint& p : to.points) {
      low = low.cwiseMin(p.normalised);
      high = high.cwiseMax(p.normalised);
    }
    int count = 0;
    for (const PlacePoint& point : from.points) {
      if (!point.p_C) continue;
      const Vec3 p = X * *point.p_C;
      if (p.z() < 0.05) continue;
      const Vec2 seen = p.head<2>() / p.z();
      if ((seen.array() >= low.array()).all() && (seen.array() <= high.array()).all()) ++count;
    }
    return count;
  };
  const int of_a = expected(a_, b_, X_BA), of_b = expected(b_, a_, X_BA.Inverse());
  const int fewer = of_a > 0 && of_b > 0 ? std::min(of_a, of_b) : std::max(of_a, of_b);
  return fewer > 0 ? std::min(1.0, static_cast<double>(inliers.size()) / fewer) : 0.0;
}

double Problem::SpreadOf(const std::vector<PointPair>& inliers) const {
  if (inliers.empty()) return 0.0;
  double least = 1e9;
  for (const bool of_a : {true, false}) {
    const auto place = [&](const PointPair& p) { return of_a ? At(a_, p.a).normalised : At(b_, p.b).normalised; };
    Vec2 mean = Vec2::Zero();
    for (const PointPair& p : inliers) mean += place(p) / static_cast<double>(inliers.size());
    double xx = 0, xy = 0, yy = 0;
    for (const PointPair& p : inliers) {
      const Vec2 d = place(p) - mean;
      xx += d.x() * d.x();
      xy += d.x() * d.y();
      yy += d.y() * d.y();
    }
    const double smaller = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
    least = std::min(least, std::sqrt(std::max(0.0, smaller) / static_cast<double>(inliers.size())));
  }
  return least;
}

/// Covariance of (δp_AB, δθ_AB) from that of (δt_BA, δθ_BA): δp_AB = [p_AB]× δθ_BA − R_AB δt_BA, δθ_AB = −R_BA δθ_BA.
Mat6 Inverted(const Mat6& covariance, const Transform& X_AB) {
  Mat6 jacobian = Mat6::Zero();
  jacobian.topLeftCorner<3, 3>() = -X_AB.R();
  jacobian.topRightCorner<3, 3>() = base::Hat(X_AB.p);
  jacobian.bottomRightCorner<3, 3>() = -X_AB.R().transpose();
  return jacobian * covariance * jacobian.transpose();
}

std::string WhyNot(const RelativePose& pose, const RelativePoseConfig& config) {
  const auto number = [](double value) { return std::to_string(value).substr(0, 5); };
  if (static_cast<int>(pose.inliers.size()) < config.min_inliers) {
    return std::to_string(pose.inliers.size()) + " inliers, " + std::to_string(config.min_inliers) + " are asked for";
  }
  if (pose.share < config.min_share) return "only " + number(pose.share) + " of what should be seen is";
  if (pose.spread < config.min_spread) return "inliers in one spot, spread " + number(pose.spread);
  const double sigma = std::sqrt(pose.covariance.topLeftCorner<3, 3>().trace());
  if (!(sigma <= config.max_position_sigma)) return "position known to " + number(sigma) + " m only";
  return {};
}

}  // namespace

RelativePose EstimateRelativePose(const PlaceView& a, const PlaceView& b, const RelativePoseConfig& config,
                                  std::uint64_t seed) {
  const Problem problem(a, b, config);
  base::RandomStream random(seed, "slam/relative_pose");
  RelativePose pose;
  pose.matches = problem.Match();
  if (pose.matches.size() < 6) {
    pose.reason = std::to_string(pose.matches.size()) + " matches with depth";
    return pose;
  }
  Transform X_BA;
  pose.inliers = problem.Sample(pose.matches, random, X_BA);
  if (pose.inliers.size() < 6) {
    pose.reason = "no pose that six matches agree on";
    return pose;
  }
  problem.Refine(pose.inliers, X_BA);
  Mat6 information = Mat6::Identity();
  for (int round = 0; round < 3; ++round) {
    pose.inliers = problem.Inliers(problem.Search(X_BA), X_BA);
    if (pose.inliers.size() < 6) break;
    information = problem.Refine(pose.inliers, X_BA);
  }
  pose.inliers = problem.Inliers(pose.inliers, X_BA);
  pose.X_AB = X_BA.Inverse();
  pose.covariance = Inverted(information.ldlt().solve(Mat6::Identity()), pose.X_AB);
  pose.spread = problem.SpreadOf(pose.inliers);
  pose.share = problem.SeenShare(pose.inliers, X_BA);
  pose.reason = WhyNot(pose, config);
  pose.accepted = pose.reason.empty();
  return pose;
}

}  // namespace alula::stack::slam
