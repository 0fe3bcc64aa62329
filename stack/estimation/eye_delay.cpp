#include "stack/estimation/eye_delay.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace alula::stack::estimation {

using base::Vec2;
using base::Vec3;

namespace {

constexpr double kForget = 0.998;     // a pair: 500 of them count
constexpr double kErrorPixels = 0.4;  // 1σ across the epipolar line
constexpr double kCertain = 5.0;      // σ
constexpr double kLeast = 0.0008;     // s: less changes nothing
constexpr double kOwnSigma = 0.0005;  // s: what a pair must say of itself to be heard
constexpr std::size_t kLeastTracks = 15;
constexpr double kLeastPast = 2000;  // matches

}  // namespace

Vec2 EyeDelay::Velocity(const features::Track& track, const EyeMotion& motion) const {
  const Vec3 p = X_RL_ * Vec3(track.depth * track.left.homogeneous());
  const Vec3 rate = -motion.v - motion.w.cross(p);
  return (rate.head<2>() - rate.z() / p.z() * p.head<2>()) / p.z();
}

double EyeDelay::Update(const std::vector<features::Track>& tracks, const EyeMotion& motion) {
  std::vector<std::pair<double, double>> pairs;  // (speed across the epipolar line, error), 1/s and normalised
  const base::Mat3 E = base::Hat(X_RL_.p) * X_RL_.R();
  for (const features::Track& track : tracks) {
    if (!track.right || track.depth <= 0.0 || (X_RL_ * Vec3(track.depth * track.left.homogeneous())).z() < 0.1)
      continue;
    const Vec3 line = E * track.left.homogeneous();
    const double length = line.head<2>().norm();
    if (length < 1e-9) continue;
    const Vec2 across = line.head<2>() / length;
    pairs.emplace_back(across.dot(Velocity(track, motion)), line.dot(track.right->homogeneous()) / length);
  }
  if (pairs.size() < kLeastTracks) return 0.0;
  const double sigma_error = kErrorPixels / rig_.right.fx;

  Sums now;
  double own = 0.0, own_vv = 0.0;
  for (const auto& [v, e] : pairs) {
    const double expected = offset_ + usual_ * v;
    // What is far off where the past says is weighed down (Huber).
    const double weight = std::min(1.0, 6.0 * sigma_error / std::max(1e-12, std::abs(e - expected)));
    now.n += weight;
    now.v += weight * v;
    now.vv += weight * v * v;
    now.e += weight * e;
    now.ev += weight * e * v;
    own += (e - offset_) * v;
    own_vv += v * v;
  }
  for (auto [sum, one] :
       {std::pair(&past_.n, now.n), {&past_.v, now.v}, {&past_.vv, now.vv}, {&past_.e, now.e}, {&past_.ev, now.ev}}) {
    *sum = kForget * *sum + one;
  }
  const double determinant = past_.n * past_.vv - past_.v * past_.v;
  if (past_.n > kLeastPast && determinant > 1e-12) {
    usual_ = (past_.n * past_.ev - past_.v * past_.e) / determinant;
    offset_ = (past_.e - usual_ * past_.v) / past_.n;
    // Matches of one pair share what is wrong with it: a tenth of them counts.
    sigma_ = sigma_error * std::sqrt(10.0 * past_.n / determinant);
  }
  if (own_vv > 0.0 && past_.n > kLeastPast) {
    const double delay = own / own_vv, sigma = sigma_error / std::sqrt(own_vv / 4.0);
    if (sigma < kOwnSigma) return std::abs(delay) > std::max(kLeast, kCertain * sigma) ? delay : 0.0;
  }
  return std::abs(usual_) > std::max(kLeast, kCertain * sigma_) ? usual_ : 0.0;
}

}  // namespace alula::stack::estimation
