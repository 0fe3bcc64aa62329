#include "stack/estimation/imu_propagator.h"

#include "base/error.h"
#include "stack/estimation/imu_preintegration.h"

namespace alula::stack::estimation {

using base::Mat3;
using base::Quat;
using base::Time;
using base::Transform;
using base::Vec3;

ImuPropagator::ImuPropagator(const Calibration& calibration) {
  if (!calibration.imu) throw base::InputError("calibration: no IMU; the propagation of the estimate needs one");
  X_BI_ = calibration.imu->X_BI;
  noise_ = calibration.imu->noise;
}

ImuPropagator::Motion ImuPropagator::Advance(const Motion& from, const TimedImu& a, const TimedImu& b, Time to) const {
  const double dt = (to - from.stamp).Seconds();
  if (dt <= 0) return from;
  const NavState& bias = corrected_->state;
  const TimedImu begin = Interpolate(a, b, from.stamp), end = Interpolate(a, b, to);
  Motion next{to, from.X_OI, from.v_OI};
  next.X_OI.q = (from.X_OI.q * base::Exp((0.5 * (begin.gyro + end.gyro) - bias.gyro_bias) * dt)).normalized();
  const Vec3 a_O = 0.5 * (from.X_OI.q * (begin.accel - bias.accel_bias) + next.X_OI.q * (end.accel - bias.accel_bias)) -
                   Vec3(0, 0, base::kGravity);
  next.X_OI.p += from.v_OI * dt + 0.5 * a_O * dt * dt;
  next.v_OI += a_O * dt;
  return next;
}

void ImuPropagator::AddImu(const TimedImu& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) return;
  if (corrected_ && !samples_.empty()) head_ = Advance(head_, samples_.back(), sample, sample.time);
  samples_.push_back(sample);
  // Without a correction for long, old samples serve nobody; with one, they are kept from its stamp on.
  constexpr std::size_t kUncorrected = 1000;
  if (!corrected_ && samples_.size() > kUncorrected) samples_.pop_front();
}

void ImuPropagator::Correct(const FrameResult& result) {
  if (!result.initialised || (corrected_ && result.state.stamp <= corrected_->state.stamp)) return;
  corrected_ = result;
  const NavState& state = result.state;
  while (samples_.size() > 1 && samples_[1].time <= state.stamp) samples_.pop_front();

  // From body to IMU: v_OI = v_OB + R_OB (w_B × p_BI).
  Vec3 w_I = Vec3::Zero();
  if (!samples_.empty()) w_I = samples_.front().gyro - state.gyro_bias;
  head_ = {state.stamp, state.X_OB * X_BI_, state.v_OB + state.X_OB.q * (X_BI_.q * w_I).cross(X_BI_.p)};
  for (std::size_t i = 1; i < samples_.size(); ++i)
    head_ = Advance(head_, samples_[i - 1], samples_[i], samples_[i].time);
}

std::optional<Estimate> ImuPropagator::At(Time now) const {
  if (!corrected_) return std::nullopt;
  Motion motion = head_;
  Vec3 w_I = Vec3::Zero();
  if (!samples_.empty()) {
    TimedImu held = samples_.back();
    w_I = held.gyro - corrected_->state.gyro_bias;
    const TimedImu last = held;
    held.time = now;
    motion = Advance(head_, last, held, now);
  }
  const Transform X_IB = X_BI_.Inverse();
  Estimate e;
  e.stamp = now;
  e.X_OB = motion.X_OI * X_IB;
  e.w_B = X_BI_.q * w_I;
  e.v_OB = motion.v_OI - e.X_OB.q * e.w_B.cross(X_BI_.p);
  e.reset_counter = corrected_->reset_counter;

  // Covariance: position grows by the velocity's, velocity by tilt and accelerometer noise, attitude by the gyroscope.
  const double dt = std::max(0.0, (now - corrected_->state.stamp).Seconds());
  const Mat3 tilt = corrected_->pose_covariance.bottomRightCorner<3, 3>();
  const double accel_variance = noise_.accelerometer_noise * noise_.accelerometer_noise * dt;
  e.pose_covariance = corrected_->pose_covariance;
  e.pose_covariance.topLeftCorner<3, 3>() += corrected_->velocity_covariance * dt * dt;
  e.pose_covariance.diagonal().tail<3>().array() += noise_.gyro_noise * noise_.gyro_noise * dt;
  e.velocity_covariance =
      corrected_->velocity_covariance +
      Mat3::Identity() * (accel_variance + tilt.trace() / 3.0 * base::kGravity * base::kGravity * dt * dt);
  return e;
}

}  // namespace alula::stack::estimation
