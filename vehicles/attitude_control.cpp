#include "vehicles/attitude_control.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

using base::Quat;
using base::Vec3;

void Describe(base::Description& d, AttitudeControlConfig& c) {
  d.Field("attitude_gain", c.attitude_gain,
          {.unit = "1/s", .meaning = "roll and pitch rate per attitude error", .min = 0.1, .max = 100});
  d.Field("yaw_gain", c.yaw_gain, {.unit = "1/s", .meaning = "yaw rate per heading error", .min = 0.05, .max = 100});
  d.Field("maximum_rate", c.maximum_rate, {.unit = "rad/s", .meaning = "roll and pitch rate limit", .min = 0.1});
  d.Field("maximum_yaw_rate", c.maximum_yaw_rate, {.unit = "rad/s", .meaning = "yaw rate limit", .min = 0.1});
  d.Field("rate_gain", c.rate_gain, {.unit = "1/s", .meaning = "angular acceleration per rate error", .min = 0});
  d.Field("rate_integral", c.rate_integral,
          {.unit = "1/s^2", .meaning = "growth of angular acceleration per rate error", .min = 0});
  d.Field("rate_derivative", c.rate_derivative, {.meaning = "share of measured angular acceleration", .min = 0});
  d.Field("maximum_integral", c.maximum_integral,
          {.unit = "rad/s^2", .meaning = "limit of the rate integral", .min = 0});
  d.Field("gyro_cutoff", c.gyro_cutoff, {.unit = "Hz", .meaning = "low-pass of the gyro", .min = 1, .max = 499});
  d.Field("derivative_cutoff", c.derivative_cutoff,
          {.unit = "Hz", .meaning = "low-pass of the gyro's derivative", .min = 1, .max = 499});
  d.Field("yaw_torque_cutoff", c.yaw_torque_cutoff,
          {.unit = "Hz", .meaning = "first-order low-pass of the yaw torque", .min = 0.1, .max = 499});
  d.Check("yaw_gain", [&c] { return c.yaw_gain <= c.attitude_gain ? "" : "must not exceed attitude_gain"; });
}

Quat AttitudeFor(const Vec3& f_O, double yaw) {
  const Vec3 z = f_O.normalized();
  const Vec3 x = Vec3(-std::sin(yaw), std::cos(yaw), 0).cross(z).normalized();  // above or below the heading
  base::Mat3 R;
  R << x, z.cross(x), z;
  return Quat(R);
}

Vec3 RateSetpoint(const AttitudeControlConfig& c, const Quat& q_OB, const Quat& q_OB_sp, double yaw_rate) {
  const Vec3 z_B = q_OB * Vec3::UnitZ(), z_sp = q_OB_sp * Vec3::UnitZ();
  // The shortest turn that aligns the thrust axis, then the rest of the way about it, weighted.
  Quat reduced = Quat::FromTwoVectors(z_B, z_sp) * q_OB;
  Quat twist = reduced.conjugate() * q_OB_sp;
  if (twist.w() < 0) twist.coeffs() = -twist.coeffs();
  const double weight = c.yaw_gain / c.attitude_gain;
  const double half = std::atan2(twist.z(), twist.w());
  reduced = reduced * Quat(std::cos(weight * half), 0, 0, std::sin(weight * half));

  Quat error = q_OB.conjugate() * reduced;
  if (error.w() < 0) error.coeffs() = -error.coeffs();
  Vec3 rate = 2 * c.attitude_gain * error.vec() + q_OB.conjugate() * Vec3(0, 0, yaw_rate);
  const Vec3 limit(c.maximum_rate, c.maximum_rate, c.maximum_yaw_rate);
  return rate.cwiseMax(-limit).cwiseMin(limit);
}

RateControl::RateControl(const AttitudeControlConfig& config, double sample_rate)
    : config_(config),
      gyro_filter_(config.gyro_cutoff, sample_rate),
      derivative_filter_(config.derivative_cutoff, sample_rate) {}

Vec3 RateControl::Step(const Vec3& w_sp, const Vec3& gyro, const Vec3& saturated, bool integrate, double dt) {
  const Vec3 before = started_ ? filtered_ : gyro;
  filtered_ = gyro_filter_.Step(gyro);
  started_ = true;
  const Vec3 derivative = derivative_filter_.Step((filtered_ - before) / dt);
  const Vec3 error = w_sp - filtered_;
  if (integrate) {
    for (int i = 0; i < 3; ++i) {
      const double growth = config_.rate_integral[i] * error[i] * dt;
      if (growth * saturated[i] > 0) continue;
      integral_[i] = std::clamp(integral_[i] + growth, -config_.maximum_integral[i], config_.maximum_integral[i]);
    }
  }
  Vec3 wanted = config_.rate_gain.cwiseProduct(error) + integral_ - config_.rate_derivative.cwiseProduct(derivative);
  yaw_ += -std::expm1(-2 * M_PI * config_.yaw_torque_cutoff * dt) * (wanted.z() - yaw_);
  wanted.z() = yaw_;
  return wanted;
}

}  // namespace alula::vehicles
