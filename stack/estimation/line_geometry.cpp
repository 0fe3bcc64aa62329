#include "stack/estimation/internal/line_geometry.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace alula::stack::estimation {

using base::Mat3;
using base::Quat;
using base::Vec3;

namespace {

Quat FrameOf(const double* x) { return {x[3], x[0], x[1], x[2]}; }

}  // namespace

PluckerLine LineThrough(const Vec3& a, const Vec3& b) {
  const Vec3 v = (b - a).normalized();
  return {a.cross(v), v};
}

void SetLine(const PluckerLine& line, double* x) {
  Mat3 U;
  U.col(1) = line.v.normalized();
  // Through the origin n vanishes: any direction across will do.
  Vec3 n = line.n - U.col(1) * U.col(1).dot(line.n);
  if (n.norm() < 1e-12 * line.v.norm()) n = U.col(1).unitOrthogonal() * 1e-12;
  U.col(0) = n.normalized();
  U.col(2) = U.col(0).cross(U.col(1));
  const Quat q(U);
  x[0] = q.x(), x[1] = q.y(), x[2] = q.z(), x[3] = q.w();
  x[4] = std::atan2(line.v.norm(), n.norm());
}

PluckerLine LineAt(const double* x) {
  const Mat3 U = FrameOf(x).toRotationMatrix();
  return {std::cos(x[4]) * U.col(0), std::sin(x[4]) * U.col(1)};
}

void LinePlus(const double* x, const double* delta, double* out) {
  const Quat q = (FrameOf(x) * base::Exp(Vec3(delta[0], delta[1], delta[2]))).normalized();
  out[0] = q.x(), out[1] = q.y(), out[2] = q.z(), out[3] = q.w();
  out[4] = x[4] + delta[3];
}

void LineJacobians(const double* x, Mat34& n_by, Mat34& v_by) {
  const Mat3 U = FrameOf(x).toRotationMatrix();
  const double c = std::cos(x[4]), s = std::sin(x[4]);
  // U Exp(δ) e₁ = u₁ + δ₃ u₂ − δ₂ u₃,  U Exp(δ) e₂ = u₂ − δ₃ u₁ + δ₁ u₃.
  n_by << Vec3::Zero(), -c * U.col(2), c * U.col(1), -s * U.col(0);
  v_by << s * U.col(2), Vec3::Zero(), -s * U.col(0), c * U.col(1);
}

Vec3 NearestOn(const PluckerLine& line, const Vec3& p) {
  const Vec3 v = line.v.normalized();
  const Vec3 foot = v.cross(line.n) / line.v.norm();  // of the origin
  return foot + v * v.dot(p - foot);
}

std::optional<Vec3> SeenAlong(const PluckerLine& line, const Vec3& origin, const Vec3& ray) {
  const Vec3 v = line.v.normalized(), d = ray.normalized();
  const Vec3 foot = v.cross(line.n) / line.v.norm();
  const double cosine = v.dot(d), across = 1.0 - cosine * cosine;
  if (across < 1e-6) return std::nullopt;
  const Vec3 w = foot - origin;
  return foot + v * ((cosine * d.dot(w) - v.dot(w)) / across);
}

std::optional<LineSpread> SpreadOf(const double* x, const Eigen::Matrix4d& information, const Vec3& p) {
  const Eigen::FullPivLU<Eigen::Matrix4d> lu(information);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Matrix4d covariance = lu.inverse();
  Mat34 n_by, v_by;
  LineJacobians(x, n_by, v_by);
  const PluckerLine line = LineAt(x);
  const double length = line.v.norm();
  const Vec3 v = line.v / length;
  // A point on the line stays on it if it moves by Δ = v × (δn − p × δv) / |v|² across it.
  const Vec3 on = NearestOn(line, p);
  const Mat34 move = base::Hat(v) * (n_by - base::Hat(on) * v_by) / length;
  const Mat34 turn = (Mat3::Identity() - v * v.transpose()) * v_by / length;
  const auto worst = [&covariance](const Mat34& J) {
    const Mat3 C = J * covariance * J.transpose();
    return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Mat3>(C).eigenvalues()[2]));
  };
  return LineSpread{worst(turn), worst(move)};
}

}  // namespace alula::stack::estimation
