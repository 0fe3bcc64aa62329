#include "vehicles/inertial_error_model.h"

namespace alula::vehicles {

using base::Exp;
using base::Hat;
using base::Mat3;
using base::Quat;
using base::Vec3;
using L = ErrorLayout;

NavigationState Plus(const NavigationState& x, const ErrorVector& delta) {
  NavigationState y = x;
  y.p_OB += delta.segment<3>(L::kPosition);
  y.v_OB += delta.segment<3>(L::kVelocity);
  y.q_OB = (x.q_OB * Exp(delta.segment<3>(L::kRotation))).normalized();
  y.accelerometer_bias += delta.segment<3>(L::kAccelerometerBias);
  y.gyro_bias += delta.segment<3>(L::kGyroBias);
  y.barometer_offset += delta[L::kBarometer];
  return y;
}

ErrorVector Minus(const NavigationState& y, const NavigationState& x) {
  ErrorVector delta;
  delta << y.p_OB - x.p_OB, y.v_OB - x.v_OB, base::Log(x.q_OB.conjugate() * y.q_OB),
      y.accelerometer_bias - x.accelerometer_bias, y.gyro_bias - x.gyro_bias, y.barometer_offset - x.barometer_offset;
  return delta;
}

void Propagate(NavigationState& x, const stack::ImuSample& imu, double dt) {
  const Vec3 half_turn = 0.5 * dt * (imu.angular_velocity - x.gyro_bias);
  const Quat half = Exp(half_turn);
  const Quat middle = x.q_OB * half;
  const Vec3 a = middle * (imu.specific_force - x.accelerometer_bias) - Vec3(0, 0, base::kGravity);
  x.p_OB += dt * (x.v_OB + 0.5 * dt * a);
  x.v_OB += dt * a;
  x.q_OB = (middle * half).normalized();
}

void InertialStretch::Add(const NavigationState& x, const stack::ImuSample& imu, double dt) {
  const Quat half = Exp(0.5 * dt * (imu.angular_velocity - x.gyro_bias));
  const Vec3 f = rotation * (half * (imu.specific_force - x.accelerometer_bias));
  displacement += dt * (velocity + 0.5 * dt * f);
  velocity += dt * f;
  rotation = (rotation * half * half).normalized();
  duration += dt;
}

ErrorMatrix Transition(const Quat& q_OB_start, const InertialStretch& s) {
  const Mat3 R = q_OB_start.toRotationMatrix(), I = Mat3::Identity();
  const double t = s.duration;
  // The mean attitude while the accelerometer's bias is summed once and twice: half and a third of the turn.
  const Vec3 turn = base::Log(s.rotation);
  const Mat3 R_half = R * Exp(turn / 2).toRotationMatrix(), R_third = R * Exp(turn / 3).toRotationMatrix();
  ErrorMatrix F = ErrorMatrix::Identity();
  F.block<3, 3>(L::kPosition, L::kVelocity) = t * I;
  F.block<3, 3>(L::kPosition, L::kRotation) = -R * Hat(s.displacement);
  F.block<3, 3>(L::kPosition, L::kAccelerometerBias) = -0.5 * t * t * R_third;
  F.block<3, 3>(L::kPosition, L::kGyroBias) = t / 3 * R * Hat(s.displacement);
  F.block<3, 3>(L::kVelocity, L::kRotation) = -R * Hat(s.velocity);
  F.block<3, 3>(L::kVelocity, L::kAccelerometerBias) = -t * R_half;
  F.block<3, 3>(L::kVelocity, L::kGyroBias) = t / 2 * R * Hat(s.velocity);
  F.block<3, 3>(L::kRotation, L::kRotation) = s.rotation.conjugate().toRotationMatrix();
  F.block<3, 3>(L::kRotation, L::kGyroBias) = -t * base::RightJacobian(turn);
  return F;
}

}  // namespace alula::vehicles
