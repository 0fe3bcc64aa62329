#include "stack/estimation/imu_preintegration.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/error.h"

namespace alula::stack::estimation {

using base::Exp;
using base::Hat;
using base::Mat3;
using base::Quat;
using base::RightJacobian;
using base::Vec3;

ImuPreintegration::ImuPreintegration(const ImuNoise& noise, const Vec3& gyro_bias, const Vec3& accel_bias)
    : noise_(noise), gyro_bias_(gyro_bias), accel_bias_(accel_bias) {}

void ImuPreintegration::Append(const std::vector<TimedImu>& samples) {
  for (const TimedImu& sample : samples) {
    if (!samples_.empty() && sample.time <= samples_.back().time) continue;
    if (!samples_.empty()) Integrate(samples_.back(), sample);
    samples_.push_back(sample);
  }
}

void ImuPreintegration::Relinearise(const Vec3& gyro_bias, const Vec3& accel_bias) {
  std::vector<TimedImu> samples = std::move(samples_);
  *this = ImuPreintegration(noise_, gyro_bias, accel_bias);
  Append(samples);
}

void ImuPreintegration::Integrate(const TimedImu& a, const TimedImu& b) {
  const double dt = (b.time - a.time).Seconds();
  const Vec3 turn = (0.5 * (a.gyro + b.gyro) - gyro_bias_) * dt;
  const Vec3 f_a = a.accel - accel_bias_, f_b = b.accel - accel_bias_;
  const Quat step = Exp(turn);
  const Quat dR_b = (dR_ * step).normalized();
  const Mat3 R_a = dR_.toRotationMatrix(), R_b = dR_b.toRotationMatrix();
  const Vec3 acceleration = 0.5 * (R_a * f_a + R_b * f_b);

  // Error transition, exact to first order for the trapezoidal rule.
  const Mat3 I = Mat3::Identity();
  const Mat3 turn_back = step.toRotationMatrix().transpose();
  const Mat3 turn_by_rate = RightJacobian(turn) * dt;
  const Mat3 R_f_a = R_a * Hat(f_a), R_f_b = R_b * Hat(f_b);
  const Mat3 a_by_theta = -0.5 * (R_f_a + R_f_b * turn_back);
  const Mat3 a_by_rate = -0.5 * R_f_b * turn_by_rate;  // rate error, not bias: sign of the bias is opposite
  const Mat3 a_by_force = 0.5 * (R_a + R_b);
  Mat15 F = Mat15::Identity();
  F.block<3, 3>(0, 0) = turn_back;
  F.block<3, 3>(0, 9) = -turn_by_rate;
  F.block<3, 3>(3, 0) = a_by_theta * dt;
  F.block<3, 3>(3, 9) = -a_by_rate * dt;
  F.block<3, 3>(3, 12) = -a_by_force * dt;
  F.block<3, 3>(6, 0) = 0.5 * a_by_theta * dt * dt;
  F.block<3, 3>(6, 3) = I * dt;
  F.block<3, 3>(6, 9) = -0.5 * a_by_rate * dt * dt;
  F.block<3, 3>(6, 12) = -0.5 * a_by_force * dt * dt;

  // White noise of density σ averages to σ²/dt over the step; it enters as a rate or force error does.
  const double gyro_variance = noise_.gyro_noise * noise_.gyro_noise / dt;
  const double accel_variance = noise_.accelerometer_noise * noise_.accelerometer_noise / dt;
  Eigen::Matrix<double, 9, 6> G;
  G << turn_by_rate, Mat3::Zero(), a_by_rate * dt, a_by_force * dt, 0.5 * a_by_rate * dt * dt,
      0.5 * a_by_force * dt * dt;
  Eigen::Matrix<double, 6, 1> q;
  q << Vec3::Constant(gyro_variance), Vec3::Constant(accel_variance);
  covariance_ = F * covariance_ * F.transpose();
  covariance_.topLeftCorner<9, 9>() += G * q.asDiagonal() * G.transpose();
  covariance_.diagonal().segment<3>(9).array() += noise_.gyro_bias_walk * noise_.gyro_bias_walk * dt;
  covariance_.diagonal().segment<3>(12).array() += noise_.accelerometer_bias_walk * noise_.accelerometer_bias_walk * dt;
  jacobian_ = F * jacobian_;

  dp_ += dv_ * dt + 0.5 * acceleration * dt * dt;
  dv_ += acceleration * dt;
  dR_ = dR_b;
  dt_ += dt;
}

ImuPreintegration::Corrected ImuPreintegration::At(const Vec3& gyro_bias, const Vec3& accel_bias) const {
  const Vec3 dg = gyro_bias - gyro_bias_, da = accel_bias - accel_bias_;
  return {dR_ * Exp(jacobian_.block<3, 3>(0, 9) * dg),
          dv_ + jacobian_.block<3, 3>(3, 9) * dg + jacobian_.block<3, 3>(3, 12) * da,
          dp_ + jacobian_.block<3, 3>(6, 9) * dg + jacobian_.block<3, 3>(6, 12) * da};
}

Mat15 ImuPreintegration::SqrtInformation() const {
  // Floors far below any real IMU keep a noiseless calibration solvable.
  Eigen::MatrixXd covariance = covariance_;
  Vec15 floor;
  floor << Vec3::Constant(1e-14), Vec3::Constant(1e-12), Vec3::Constant(1e-12), Vec3::Constant(1e-16),
      Vec3::Constant(1e-14);
  covariance.diagonal() += floor;
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  if (samples_.size() < 2 || llt.info() != Eigen::Success) {
    throw base::FaultError("imu_preintegration", "the covariance of an inertial interval is not positive definite");
  }
  return llt.matrixL().solve(Eigen::MatrixXd::Identity(15, 15));
}

TimedImu Interpolate(const TimedImu& a, const TimedImu& b, base::Time time) {
  if (a.time == b.time) return {time, a.gyro, a.accel};
  const double s = (time - a.time).Seconds() / (b.time - a.time).Seconds();
  return {time, a.gyro + s * (b.gyro - a.gyro), a.accel + s * (b.accel - a.accel)};
}

std::vector<TimedImu> Cut(const std::vector<TimedImu>& samples, base::Time from, base::Time to) {
  const auto at = [&samples](base::Time time) {
    const auto after = std::lower_bound(samples.begin(), samples.end(), time,
                                        [](const TimedImu& s, base::Time t) { return s.time < t; });
    if (after == samples.end()) return TimedImu{time, samples.back().gyro, samples.back().accel};
    if (after == samples.begin()) return TimedImu{time, after->gyro, after->accel};
    return Interpolate(*(after - 1), *after, time);
  };
  std::vector<TimedImu> cut{at(from)};
  for (const TimedImu& s : samples) {
    if (s.time > from && s.time < to) cut.push_back(s);
  }
  cut.push_back(at(to));
  return cut;
}

}  // namespace alula::stack::estimation
