#pragma once

#include <cmath>
#include <vector>

#include "base/random.h"
#include "scenarios/trajectory/pose_pairs.h"

namespace alula::scenarios::trajectory::testing {

inline base::Time At(double seconds) { return base::Time{} + base::Seconds(seconds); }

/// A smooth path through space with turning attitude, at `rate` poses a second.
inline std::vector<base::StampedPose> Walk(int poses, double rate) {
  std::vector<base::StampedPose> walk;
  for (int i = 0; i < poses; ++i) {
    const double t = i / rate;
    walk.push_back({At(t),
                    {base::FromYawPitchRoll(0.4 * t, 0.2 * std::sin(t), 0.3 * std::cos(0.7 * t)),
                     {4 * std::sin(0.5 * t), 3 * std::cos(0.3 * t), 1 + 0.5 * std::sin(0.9 * t)}}});
  }
  return walk;
}

/// A straight way along x at 1 m/s.
inline std::vector<base::StampedPose> StraightWay(int poses, double rate) {
  std::vector<base::StampedPose> way;
  for (int i = 0; i < poses; ++i) way.push_back({At(i / rate), {base::Quat::Identity(), {i / rate, 0, 0}}});
  return way;
}

/// X applied from the left and noise (1σ, m and rad) from the right.
inline std::vector<base::StampedPose> Disturbed(std::vector<base::StampedPose> poses, const base::Transform& X,
                                                double position_sigma, double rotation_sigma, std::uint64_t seed) {
  base::RandomStream random(seed, "disturbed");
  for (base::StampedPose& pose : poses) {
    pose.X_FS = X * pose.X_FS;
    pose.X_FS.p += position_sigma * random.GaussianVec3();
    pose.X_FS.q = pose.X_FS.q * base::Exp(rotation_sigma * random.GaussianVec3());
  }
  return poses;
}

}  // namespace alula::scenarios::trajectory::testing
