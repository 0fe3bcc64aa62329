#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Frames and rigid transforms; the conventions of the whole house are stated here and nowhere else.
///
///   W  world: ENU, x east, y north, z up.          O  odometry frame: z up, never jumps.   M  map frame: may jump.
///   B  body:  x forward, y left, z up (FLU).       C  camera: x right, y down, z forward (optical axis).
///   I  IMU:   its own frame, given by extrinsics.  G  gate: x along the direction of passage, z up, origin
///   mid-opening.
///
/// `X_AB` is the pose of frame B in frame A (p_A = X_AB * p_B), `R_AB`/`q_AB` its rotation, `p_AB` the position of B's
/// origin in A expressed in A, `v_AB` the velocity of B's origin relative to A expressed in A (`v_AB_C`: expressed in
/// C). Products chain letters: X_WC = X_WB * X_BC. `w_B` is the angular velocity of B in W expressed in B. Hamilton
/// quaternions; rotations are perturbed on the right: R ← R·Exp(δθ). SI units and radians everywhere.
namespace alula::base {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Standard gravity, m/s².
inline constexpr double kGravity = 9.80665;

/// Skew-symmetric matrix: Hat(a) * b = a × b.
Mat3 Hat(const Vec3& a);

/// Exponential map so(3) → SO(3) of a rotation vector (rad); exact to rounding also near zero.
Quat Exp(const Vec3& rotation_vector);

/// Logarithm SO(3) → so(3), norm in [0, π].
Vec3 Log(const Quat& q);

/// Right Jacobian of SO(3): Exp(φ + δ) ≈ Exp(φ) Exp(J_r(φ) δ). (Forster et al. 2017, eq. 8)
Mat3 RightJacobian(const Vec3& rotation_vector);
Mat3 RightJacobianInverse(const Vec3& rotation_vector);

/// Heading of the body x axis in the world's horizontal plane, rad in (−π, π].
double Yaw(const Quat& q_WB);
Quat FromYaw(double yaw);
/// From yaw, pitch, roll (intrinsic z-y'-x''), rad.
Quat FromYawPitchRoll(double yaw, double pitch, double roll);
/// Wraps to (−π, π].
double WrapAngle(double angle);

/// A rigid transform X_AB: rotation q_AB and position p_AB.
struct Transform {
  Quat q = Quat::Identity();
  Vec3 p = Vec3::Zero();

  Mat3 R() const { return q.toRotationMatrix(); }
  Vec3 operator*(const Vec3& point) const { return q * point + p; }
  Transform operator*(const Transform& o) const { return {(q * o.q).normalized(), q * o.p + p}; }
  Transform Inverse() const { return {q.conjugate(), -(q.conjugate() * p)}; }
};

/// Maps camera axes (right-down-forward) to body axes (forward-left-up) for a camera that looks along body x.
Quat ForwardCameraRotation();  // q_BC

}  // namespace alula::base
