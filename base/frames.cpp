#include "base/frames.h"

#include <cmath>

namespace alula::base {

Mat3 Hat(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Quat Exp(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double half = 0.5 * angle;
  // sin(x)/x by its series below 1e-4: the next term is under 1e-17.
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  const Vec3 v = scale * rotation_vector;
  return Quat(std::cos(half), v.x(), v.y(), v.z());
}

Vec3 Log(const Quat& q_in) {
  Quat q = q_in.normalized();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Vec3 v = q.vec();
  const double n = v.norm();
  if (n < 1e-8) return 2.0 * v;  // relative error n²/6
  return v * (2.0 * std::atan2(n, q.w()) / n);
}

Mat3 RightJacobian(const Vec3& rotation_vector) {
  const double t = rotation_vector.norm();
  const Mat3 h = Hat(rotation_vector);
  if (t < 1e-4) return Mat3::Identity() - 0.5 * h + h * h / 6.0;
  return Mat3::Identity() - (1 - std::cos(t)) / (t * t) * h + (t - std::sin(t)) / (t * t * t) * h * h;
}

Mat3 RightJacobianInverse(const Vec3& rotation_vector) {
  const double t = rotation_vector.norm();
  const Mat3 h = Hat(rotation_vector);
  if (t < 1e-4) return Mat3::Identity() + 0.5 * h + h * h / 12.0;
  return Mat3::Identity() + 0.5 * h + (1.0 / (t * t) - (1 + std::cos(t)) / (2 * t * std::sin(t))) * h * h;
}

double Yaw(const Quat& q_WB) {
  const Vec3 x_W = q_WB * Vec3::UnitX();
  return std::atan2(x_W.y(), x_W.x());
}

Quat FromYaw(double yaw) { return Quat(std::cos(0.5 * yaw), 0, 0, std::sin(0.5 * yaw)); }

Quat FromYawPitchRoll(double yaw, double pitch, double roll) {
  return Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
              Eigen::AngleAxisd(roll, Vec3::UnitX()));
}

double WrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2 * M_PI);  // in [−π, π]
  return wrapped == -M_PI ? M_PI : wrapped;
}

Quat ForwardCameraRotation() {
  Mat3 R_BC;  // columns: camera axes in the body frame
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Quat(R_BC);
}

}  // namespace alula::base
