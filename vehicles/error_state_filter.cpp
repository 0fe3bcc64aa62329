#include "vehicles/error_state_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace alula::vehicles {

using base::Exp;
using base::Hat;
using base::Mat3;
using base::Quat;
using base::Vec3;
using L = ErrorLayout;

namespace {

// The covariance is carried over stretches of this length; the nominal state over single samples.
constexpr double kStretch = 0.010;  // s
// The uncertainty of a barometer's offset before the first reading, and after a jump of the odometry, m.
constexpr double kUnknownOffset = 3.0;
constexpr double kStandingSpeed = 0.02;  // m/s, 1σ when standing
// 1σ that tilt and biases are given anew when estimates have not fitted for long: an IMU that was dropped, or has come
// loose, may be off by that much.
constexpr double kDoubtfulTilt = 0.1;           // rad
constexpr double kDoubtfulGyro = 0.05;          // rad/s
constexpr double kDoubtfulAccelerometer = 0.3;  // m/s²

/// The chi-square quantile of k degrees of freedom at the normal quantile z (Wilson and Hilferty 1931).
double ChiSquare(int k, double z) {
  const double a = 2.0 / (9.0 * k);
  return k * std::pow(1 - a + z * std::sqrt(a), 3);
}

/// d yaw / d δθ for R Exp(δθ).
Eigen::RowVector3d YawJacobian(const Mat3& R) {
  const double n = R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0);
  return {0.0, (R(1, 0) * R(0, 2) - R(0, 0) * R(1, 2)) / n, (R(0, 0) * R(1, 1) - R(1, 0) * R(0, 1)) / n};
}

bool SaysVelocity(const stack::Estimate& estimate) { return estimate.velocity_covariance.trace() > 0; }

}  // namespace

ErrorStateFilter::ErrorStateFilter(const ErrorStateFilterConfig& config)
    : config_(config),
      gate_pose_(ChiSquare(4, config.gate)),
      gate_velocity_(ChiSquare(3, config.gate)),
      gate_height_(ChiSquare(1, config.gate)) {}

void ErrorStateFilter::AddInertial(base::Time now, const stack::ImuSample& imu,
                                   std::optional<double> barometric_height) {
  const base::Time before = has_tick_ ? present_time_ : now;
  has_tick_ = true;
  present_time_ = now;
  if (!initialised_) {
    if (barometric_height) still_height_ = barometric_height;
    WatchStandstill(now, imu);
    return;
  }
  samples_.push_back({before, now, imu, barometric_height});
  Propagate(present_, imu, (now - before).Seconds());
  // Estimates are silent: let the filter follow at the horizon, a stretch at a time.
  if (now - delayed_time_ > config_.horizon + base::Seconds(kStretch)) {
    AdvanceTo(base::Time{} + (now - base::Time{} - config_.horizon));
    Replay();
  }
}

void ErrorStateFilter::WatchStandstill(base::Time now, const stack::ImuSample& imu) {
  Standstill& s = standstill_;
  if (s.count == 0) standstill_since_ = now;
  ++s.count;
  s.gyro_sum += imu.angular_velocity;
  s.force_sum += imu.specific_force;
  s.gyro_squares += imu.angular_velocity.cwiseAbs2();
  s.force_squares += imu.specific_force.cwiseAbs2();
  if (now - standstill_since_ < config_.standstill) return;

  const Vec3 gyro = s.gyro_sum / s.count, force = s.force_sum / s.count;
  const Vec3 gyro_variance = s.gyro_squares / s.count - gyro.cwiseAbs2();
  const Vec3 force_variance = s.force_squares / s.count - force.cwiseAbs2();
  const double limit = config_.standstill_gyro * config_.standstill_gyro;
  const double force_limit = config_.standstill_accelerometer * config_.standstill_accelerometer;
  stands_still_ = gyro_variance.maxCoeff() < limit && force_variance.maxCoeff() < force_limit &&
                  gyro.norm() < 5 * config_.gyro_turn_on_bias + config_.standstill_gyro &&
                  std::abs(force.norm() - base::kGravity) < 5 * config_.accelerometer_turn_on_bias + 0.1;
  still_gyro_ = gyro;
  still_force_ = force;
  standstill_ = Standstill();
}

void ErrorStateFilter::Initialise(const stack::Estimate& estimate) {
  const Vec3 up_B = still_force_.normalized();
  const Quat level = Quat::FromTwoVectors(up_B, Vec3::UnitZ());  // any heading
  const double turn = base::Yaw(estimate.X_OB.q) - base::Yaw(level);
  present_ = NavigationState{.p_OB = estimate.X_OB.p, .q_OB = base::FromYaw(turn) * level, .gyro_bias = still_gyro_};
  present_.barometer_offset = still_height_ ? *still_height_ - estimate.X_OB.p.z() : 0.0;

  ErrorMatrix& P = covariance_;
  P.setZero();
  const Mat3 R = present_.q_OB.toRotationMatrix();
  const Vec3 floor = Vec3::Constant(config_.vision_position_floor * config_.vision_position_floor);
  P.block<3, 3>(L::kPosition, L::kPosition) = estimate.pose_covariance.topLeftCorner<3, 3>();
  P.block<3, 3>(L::kPosition, L::kPosition).diagonal() += floor;
  P.block<3, 3>(L::kVelocity, L::kVelocity) = kStandingSpeed * kStandingSpeed * Mat3::Identity();
  // Levelling takes the accelerometer's bias b for tilt: g δθ = up × b. The two errors are one.
  const double bias = config_.accelerometer_turn_on_bias * config_.accelerometer_turn_on_bias;
  const double noise = config_.accelerometer_noise * config_.accelerometer_noise / config_.standstill.Seconds();
  const Mat3 levelling = Hat(up_B) / base::kGravity;
  const Eigen::RowVector3d turned = YawJacobian(R);
  const double yaw = turned * estimate.pose_covariance.bottomRightCorner<3, 3>() * turned.transpose() +
                     config_.vision_yaw_floor * config_.vision_yaw_floor;
  P.block<3, 3>(L::kAccelerometerBias, L::kAccelerometerBias) = bias * Mat3::Identity();
  P.block<3, 3>(L::kRotation, L::kRotation) =
      (bias + noise) * levelling * levelling.transpose() + yaw * up_B * up_B.transpose();
  P.block<3, 3>(L::kRotation, L::kAccelerometerBias) = bias * levelling;
  P.block<3, 3>(L::kAccelerometerBias, L::kRotation) = bias * levelling.transpose();
  const double gyro = config_.gyro_noise * config_.gyro_noise / config_.standstill.Seconds() +
                      config_.gyro_bias_walk * config_.gyro_bias_walk;
  P.block<3, 3>(L::kGyroBias, L::kGyroBias) = gyro * Mat3::Identity();
  const double offset = still_height_ ? config_.barometer_noise : kUnknownOffset;
  P(L::kBarometer, L::kBarometer) = offset * offset;

  delayed_ = present_;
  delayed_time_ = present_time_;
  initialised_ = true;
}

void ErrorStateFilter::AddEstimate(base::Time now, const stack::Estimate& estimate) {
  const base::Time stamp = std::min(estimate.stamp, present_time_);
  if (!initialised_) {
    if (!stands_still_) return;
    Initialise(estimate);
  } else if (estimate.reset_counter != reset_counter_) {
    AdvanceTo(stamp);
    Reinitialise(estimate);
  } else {
    if (stamp < delayed_time_ || (last_stamp_ && stamp - *last_stamp_ < config_.vision_interval)) return;
    AdvanceTo(stamp);
    if (FuseEstimate(estimate)) {
      rejecting_since_.reset();
    } else {
      ++rejected_;
      last_stamp_ = stamp;
      if (!rejecting_since_) rejecting_since_ = now;
      if (now - *rejecting_since_ < config_.rejection_timeout) {
        Replay();
        return;
      }
      Doubt();
      Reinitialise(estimate);
    }
    Replay();
  }
  reset_counter_ = estimate.reset_counter;
  last_fused_ = now;
  last_stamp_ = stamp;
}

void ErrorStateFilter::AdvanceTo(base::Time target) {
  Quat q_start = delayed_.q_OB;
  InertialStretch stretch;
  while (!samples_.empty() && delayed_time_ < target) {
    const Sample& sample = samples_.front();
    const base::Time end = std::min(sample.end, target);
    const double dt = (end - delayed_time_).Seconds();
    stretch.Add(delayed_, sample.imu, dt);
    Propagate(delayed_, sample.imu, dt);
    delayed_time_ = end;
    const bool consumed = end == sample.end;
    const std::optional<double> height = consumed ? sample.barometric_height : std::nullopt;
    if (consumed) samples_.pop_front();
    if (height || stretch.duration >= kStretch - 1e-9 || delayed_time_ >= target || samples_.empty()) {
      PropagateCovariance(q_start, stretch);
      if (height) FuseHeight(*height);
      q_start = delayed_.q_OB;
      stretch = InertialStretch();
    }
  }
}

void ErrorStateFilter::PropagateCovariance(const Quat& q_start, const InertialStretch& stretch) {
  const ErrorMatrix F = Transition(q_start, stretch);
  const ErrorMatrix FP = F * covariance_;
  covariance_.noalias() = FP * F.transpose();
  const auto add = [this, t = stretch.duration](int block, int size, double density) {
    covariance_.diagonal().segment(block, size).array() += density * density * t;
  };
  add(L::kVelocity, 3, config_.accelerometer_noise);
  add(L::kRotation, 3, config_.gyro_noise);
  add(L::kAccelerometerBias, 3, config_.accelerometer_bias_walk);
  add(L::kGyroBias, 3, config_.gyro_bias_walk);
  add(L::kBarometer, 1, config_.barometer_drift);
}

void ErrorStateFilter::FuseHeight(double barometric_height) {
  const double innovation = barometric_height - (delayed_.p_OB.z() + delayed_.barometer_offset);
  const ErrorVector PH = covariance_.col(L::kPosition + 2) + covariance_.col(L::kBarometer);
  const double S = PH[L::kPosition + 2] + PH[L::kBarometer] + config_.barometer_noise * config_.barometer_noise;
  if (innovation * innovation > gate_height_ * S) return;
  covariance_.noalias() -= PH * PH.transpose() / S;
  Inject(PH * (innovation / S));
}

bool ErrorStateFilter::FuseEstimate(const stack::Estimate& estimate) {
  {
    Eigen::Matrix<double, 4, L::kSize> H = Eigen::Matrix<double, 4, L::kSize>::Zero();
    H.block<3, 3>(0, L::kPosition).setIdentity();
    H.block<1, 3>(3, L::kRotation) = YawJacobian(delayed_.q_OB.toRotationMatrix());
    const Eigen::RowVector3d turned = YawJacobian(estimate.X_OB.R());
    Eigen::Matrix4d R = Eigen::Matrix4d::Zero();
    R.topLeftCorner<3, 3>() = estimate.pose_covariance.topLeftCorner<3, 3>();
    R(3, 3) = turned * estimate.pose_covariance.bottomRightCorner<3, 3>() * turned.transpose();
    const double p = config_.vision_position_floor, yaw = config_.vision_yaw_floor;
    R.diagonal() = R.diagonal().cwiseMax(Eigen::Vector4d(p * p, p * p, p * p, yaw * yaw));
    Eigen::Vector4d innovation;
    innovation << estimate.X_OB.p - delayed_.p_OB,
        base::WrapAngle(base::Yaw(estimate.X_OB.q) - base::Yaw(delayed_.q_OB));
    const Eigen::Matrix<double, L::kSize, 4> PH = covariance_ * H.transpose();
    const Eigen::Matrix4d S = H * PH + R;
    const Eigen::LLT<Eigen::Matrix4d> llt(S);
    if (!(innovation.dot(llt.solve(innovation)) < gate_pose_)) return false;
    const Eigen::Matrix<double, L::kSize, 4> K = llt.solve(PH.transpose()).transpose();
    covariance_.noalias() -= K * PH.transpose();
    Inject(K * innovation);
  }
  if (SaysVelocity(estimate)) {
    Mat3 R = estimate.velocity_covariance;
    R.diagonal() = R.diagonal().cwiseMax(Vec3::Constant(config_.vision_velocity_floor * config_.vision_velocity_floor));
    const Vec3 innovation = estimate.v_OB - delayed_.v_OB;
    const Eigen::Matrix<double, L::kSize, 3> PH = covariance_.middleCols<3>(L::kVelocity);
    const Eigen::LLT<Mat3> llt(Mat3(PH.middleRows<3>(L::kVelocity) + R));
    if (innovation.dot(llt.solve(innovation)) < gate_velocity_) {
      const Eigen::Matrix<double, L::kSize, 3> K = llt.solve(PH.transpose()).transpose();
      covariance_.noalias() -= K * PH.transpose();
      Inject(K * innovation);
    }
  }
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  return true;
}

void ErrorStateFilter::Inject(const ErrorVector& delta) { delayed_ = Plus(delayed_, delta); }

void ErrorStateFilter::Forget(int block, int size) {
  covariance_.middleRows(block, size).setZero();
  covariance_.middleCols(block, size).setZero();
}

void ErrorStateFilter::Doubt() {
  const auto add = [this](int block, double sigma) {
    covariance_.diagonal().segment<3>(block).array() += sigma * sigma;
  };
  add(L::kRotation, kDoubtfulTilt);
  add(L::kGyroBias, kDoubtfulGyro);
  add(L::kAccelerometerBias, kDoubtfulAccelerometer);
}

void ErrorStateFilter::Reinitialise(const stack::Estimate& estimate) {
  const NavigationState before = present_;
  const double yaw_step = base::WrapAngle(base::Yaw(estimate.X_OB.q) - base::Yaw(delayed_.q_OB));
  const Quat turn = base::FromYaw(yaw_step);
  delayed_.barometer_offset += delayed_.p_OB.z() - estimate.X_OB.p.z();
  delayed_.p_OB = estimate.X_OB.p;
  delayed_.v_OB = SaysVelocity(estimate) ? estimate.v_OB : Vec3(turn * delayed_.v_OB);
  delayed_.q_OB = (turn * delayed_.q_OB).normalized();

  const Vec3 up_B = delayed_.q_OB.conjugate() * Vec3::UnitZ();
  const Eigen::RowVector3d turned = YawJacobian(estimate.X_OB.R());
  const double yaw = turned * estimate.pose_covariance.bottomRightCorner<3, 3>() * turned.transpose() +
                     config_.vision_yaw_floor * config_.vision_yaw_floor;
  const double floor = config_.vision_position_floor * config_.vision_position_floor;
  const double speed = config_.vision_velocity_floor * config_.vision_velocity_floor;
  const Mat3 velocity =
      SaysVelocity(estimate) ? estimate.velocity_covariance : Mat3(covariance_.block<3, 3>(L::kVelocity, L::kVelocity));
  Forget(L::kPosition, 3);
  Forget(L::kVelocity, 3);
  Forget(L::kBarometer, 1);
  covariance_.block<3, 3>(L::kPosition, L::kPosition) =
      Mat3(estimate.pose_covariance.topLeftCorner<3, 3>()) + floor * Mat3::Identity();
  covariance_.block<3, 3>(L::kVelocity, L::kVelocity) = velocity + speed * Mat3::Identity();
  covariance_.block<3, 3>(L::kRotation, L::kRotation) += yaw * up_B * up_B.transpose();
  covariance_(L::kBarometer, L::kBarometer) = kUnknownOffset * kUnknownOffset;
  rejecting_since_.reset();

  Replay();
  last_jump_ = {present_.p_OB - before.p_OB, yaw_step};
  ++jumps_;
}

void ErrorStateFilter::Replay() {
  present_ = delayed_;
  base::Time at = delayed_time_;
  for (const Sample& sample : samples_) {
    Propagate(present_, sample.imu, (sample.end - std::max(at, sample.start)).Seconds());
    at = sample.end;
  }
}

}  // namespace alula::vehicles
