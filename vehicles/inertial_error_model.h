#pragma once

#include <Eigen/Core>

#include "base/frames.h"
#include "stack/interface/measurement.h"

namespace alula::vehicles {

/// Layout of the error state: right perturbation R = R̂ Exp(δθ), everything else additive.
struct ErrorLayout {
  static constexpr int kPosition = 0;           // δp_OB, m
  static constexpr int kVelocity = 3;           // δv_OB, m/s
  static constexpr int kRotation = 6;           // δθ, rad, body axes
  static constexpr int kAccelerometerBias = 9;  // δb_a, m/s²
  static constexpr int kGyroBias = 12;          // δb_g, rad/s
  static constexpr int kBarometer = 15;         // δb_h, m: barometric height minus odometry height
  static constexpr int kSize = 16;
};
using ErrorVector = Eigen::Matrix<double, ErrorLayout::kSize, 1>;
using ErrorMatrix = Eigen::Matrix<double, ErrorLayout::kSize, ErrorLayout::kSize>;

/// The nominal state.
struct NavigationState {
  base::Vec3 p_OB = base::Vec3::Zero();
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Quat q_OB = base::Quat::Identity();
  base::Vec3 accelerometer_bias = base::Vec3::Zero();
  base::Vec3 gyro_bias = base::Vec3::Zero();
  double barometer_offset = 0.0;
};

/// x ⊞ δ.
NavigationState Plus(const NavigationState& x, const ErrorVector& delta);
/// δ with x ⊞ δ = y.
ErrorVector Minus(const NavigationState& y, const NavigationState& x);

/// One IMU sample held for dt (s), attitude at mid-interval for the specific force:
///   a = R Exp(½ ω dt) (f − b_a) + g,  p += v dt + ½ a dt²,  v += a dt,  R ← R Exp(ω dt),  ω = w − b_g.
void Propagate(NavigationState& x, const stack::ImuSample& imu, double dt);

/// Motion over a stretch of IMU samples from its first attitude R_0, gravity excluded.
struct InertialStretch {
  double duration = 0.0;                         // s
  base::Vec3 velocity = base::Vec3::Zero();      // R_0ᵀ ∫ R f
  base::Vec3 displacement = base::Vec3::Zero();  // R_0ᵀ ∬ R f
  base::Quat rotation = base::Quat::Identity();  // R_0ᵀ R_1
  void Add(const NavigationState& x, const stack::ImuSample& imu, double dt);
};

/// Transition of the error state over a stretch (Solà 2017, eqs. 269–270, extended from one sample to a stretch of a
/// few milliseconds; bias columns to second order in its duration).
ErrorMatrix Transition(const base::Quat& q_OB_start, const InertialStretch& stretch);

}  // namespace alula::vehicles
