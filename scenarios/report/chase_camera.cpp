#include "scenarios/report/chase_camera.h"

#include <cmath>

namespace alula::scenarios {

namespace {

constexpr double kBehind = 2.0;         // m
constexpr double kAbove = 0.75;         // m
constexpr double kAhead = 0.6;          // the point looked at lies so far before the vehicle, m
constexpr double kPositionTime = 0.25;  // s, first-order smoothing
constexpr double kYawTime = 0.6;        // s
constexpr double kMargin = 0.3;         // distance kept from the walls, m

}  // namespace

base::Transform LookAt(const base::Vec3& eye_W, const base::Vec3& target_W) {
  const base::Vec3 forward = (target_W - eye_W).normalized();
  const base::Vec3 right = forward.cross(base::Vec3::UnitZ()).normalized();
  base::Mat3 R_WC;
  R_WC.col(0) = right;
  R_WC.col(1) = forward.cross(right);
  R_WC.col(2) = forward;
  return {base::Quat(R_WC), eye_W};
}

base::Transform ChaseCamera::Follow(const base::Transform& X_WB, base::Duration dt) {
  const double yaw = base::Yaw(X_WB.q);
  const double gain_p = started_ ? 1.0 - std::exp(-dt.Seconds() / kPositionTime) : 1.0;
  const double gain_yaw = started_ ? 1.0 - std::exp(-dt.Seconds() / kYawTime) : 1.0;
  started_ = true;
  yaw_ = base::WrapAngle(yaw_ + gain_yaw * base::WrapAngle(yaw - yaw_));
  const base::Vec3 heading(std::cos(yaw_), std::sin(yaw_), 0.0);
  base::Vec3 eye = X_WB.p - kBehind * heading + kAbove * base::Vec3::UnitZ();
  const base::Vec3 margin = base::Vec3::Constant(kMargin);
  eye = eye.cwiseMax(low_W_ + margin).cwiseMin(high_W_ + 3.0 * base::Vec3::UnitZ() - margin);
  p_WC_ += gain_p * (eye - p_WC_);
  look_W_ += gain_p * (X_WB.p + kAhead * heading - look_W_);
  return LookAt(p_WC_, look_W_);
}

}  // namespace alula::scenarios
