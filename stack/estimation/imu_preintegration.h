#pragma once

#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/estimation/odometry.h"

namespace alula::stack::estimation {

using Mat15 = Eigen::Matrix<double, 15, 15>;
using Vec15 = Eigen::Matrix<double, 15, 1>;

/// What the IMU alone says about the motion from one instant to a later one, in the IMU frame of the first
/// (Forster et al. 2017, "On-manifold preintegration", sections V and VI), integrated by the trapezoidal rule:
///
///   dR = Π Exp((w − b_g) dt),   dv = Σ dR (a − b_a) dt,   dp = Σ dv dt + ½ dR (a − b_a) dt²,
///
/// with covariance and first-order dependence on the biases. Errors are ordered (δθ, δv, δp, δb_g, δb_a): rotation by
/// right perturbation, the last two the walk of the biases in between.
class ImuPreintegration {
 public:
  /// Noise densities as calibrated; biases about which the integral is linearised.
  ImuPreintegration(const ImuNoise& noise, const base::Vec3& gyro_bias, const base::Vec3& accel_bias);

  /// Appends samples; the first stands where the last of the earlier ones stood (or begins the interval).
  void Append(const std::vector<TimedImu>& samples);
  /// Integrates all samples again about other biases.
  void Relinearise(const base::Vec3& gyro_bias, const base::Vec3& accel_bias);

  double dt() const { return dt_; }  // s
  const base::Quat& dR() const { return dR_; }
  const base::Vec3& dv() const { return dv_; }
  const base::Vec3& dp() const { return dp_; }
  const base::Vec3& gyro_bias() const { return gyro_bias_; }
  const base::Vec3& accel_bias() const { return accel_bias_; }
  const Mat15& covariance() const { return covariance_; }
  /// ∂(δθ, δv, δp, δb_g, δb_a) at the end / the same at the beginning; columns 9…14 are the bias Jacobians.
  const Mat15& jacobian() const { return jacobian_; }
  const std::vector<TimedImu>& samples() const { return samples_; }

  /// The integral at other biases, to first order (ibid., eq. 44).
  struct Corrected {
    base::Quat dR;
    base::Vec3 dv, dp;
  };
  Corrected At(const base::Vec3& gyro_bias, const base::Vec3& accel_bias) const;

  /// W with WᵀW = covariance⁻¹. Throws base::FaultError where nothing was integrated.
  Mat15 SqrtInformation() const;

 private:
  void Integrate(const TimedImu& a, const TimedImu& b);

  ImuNoise noise_;
  base::Vec3 gyro_bias_, accel_bias_;
  double dt_ = 0.0;
  base::Quat dR_ = base::Quat::Identity();
  base::Vec3 dv_ = base::Vec3::Zero(), dp_ = base::Vec3::Zero();
  Mat15 covariance_ = Mat15::Zero();
  Mat15 jacobian_ = Mat15::Identity();
  std::vector<TimedImu> samples_;
};

/// A sample at `time` between (or beyond) a and b, linear in time.
TimedImu Interpolate(const TimedImu& a, const TimedImu& b, base::Time time);

/// The samples that cover [from, to], the ends interpolated; the nearest sample is held where none lies beyond an end.
/// `samples` in order of time, at least one.
std::vector<TimedImu> Cut(const std::vector<TimedImu>& samples, base::Time from, base::Time to);

}  // namespace alula::stack::estimation
