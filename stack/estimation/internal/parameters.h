#pragma once

#include <Eigen/Core>

#include "base/frames.h"

namespace alula::stack::estimation {

/// Parameter blocks as the solver sees them, all doubles of one arena:
///   pose        7: p_OI (m), q_OI (x y z w); tangent 6: (δp in O, δθ in I), right perturbation
///   speed-bias  9: v_OI (m/s), gyroscope bias (rad/s), accelerometer bias (m/s²)
///   rig         6: left camera's rotation error (rad), right eye's rotation about its x and y (rad), time offset (s)
///   landmark    3: p_O (m)
inline constexpr int kPoseSize = 7, kPoseTangent = 6, kSpeedBiasSize = 9, kRigSize = 6, kLandmarkSize = 3;

inline base::Transform PoseOf(const double* pose) {
  return {base::Quat(pose[6], pose[3], pose[4], pose[5]), base::Vec3(pose[0], pose[1], pose[2])};
}
inline void SetPose(const base::Transform& X, double* pose) {
  pose[0] = X.p.x(), pose[1] = X.p.y(), pose[2] = X.p.z();
  pose[3] = X.q.x(), pose[4] = X.q.y(), pose[5] = X.q.z(), pose[6] = X.q.w();
}
inline base::Vec3 Vec3At(const double* x) { return {x[0], x[1], x[2]}; }

/// x ⊟ x0 of a pose: (p − p0, Log(q0⁻¹ q)).
inline base::Vec6 PoseDifference(const double* x, const double* x0) {
  const base::Transform a = PoseOf(x), b = PoseOf(x0);
  base::Vec6 d;
  d << a.p - b.p, base::Log(b.q.conjugate() * a.q);
  return d;
}

/// x ⊞ δ of a pose.
inline void PosePlus(const double* x, const double* delta, double* out) {
  const base::Transform X = PoseOf(x);
  SetPose({(X.q * base::Exp(Vec3At(delta + 3))).normalized(), X.p + Vec3At(delta)}, out);
}

}  // namespace alula::stack::estimation
