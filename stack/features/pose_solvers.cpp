#include "stack/features/pose_solvers.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

namespace alula::stack::features {

using base::Mat3;
using base::Quat;
using base::Transform;
using base::Vec2;
using base::Vec3;

std::vector<Transform> SolveThreePoints(const std::array<PointAndRay, 3>& points) {
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> seen;
  for (const PointAndRay& p : points) {
    places.emplace_back(p.p.x(), p.p.y(), p.p.z());
    seen.emplace_back(p.seen.x(), p.seen.y());
  }
  std::vector<cv::Mat> turns, shifts;
  cv::solveP3P(places, seen, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), turns, shifts, cv::SOLVEPNP_AP3P);
  std::vector<Transform> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto vector = [](const cv::Mat& m) { return Vec3(m.at<double>(0), m.at<double>(1), m.at<double>(2)); };
    const Transform X_TS{base::Exp(vector(turns[i])), vector(shifts[i])};
    if (X_TS.p.allFinite() && X_TS.q.coeffs().allFinite()) poses.push_back(X_TS);
  }
  return poses;
}

std::vector<Transform> SolveTwoPoints(const std::array<PointAndRay, 2>& points, const Vec3& up_S, const Vec3& up_T) {
  // Level frames: z up, heading as it comes.
  const Quat q_LS = Quat::FromTwoVectors(up_S, Vec3::UnitZ()), q_LT = Quat::FromTwoVectors(up_T, Vec3::UnitZ());
  const Vec3 first = q_LS * points[0].p, step = q_LS * Vec3(points[1].p - points[0].p);
  const Vec3 ray = q_LT * Vec3(points[0].seen.homogeneous()), other = q_LT * Vec3(points[1].seen.homogeneous());
  // With R the rotation about z: R first + t = λ ray, hence e·(R step + λ ray) = 0 for both e across the other ray.
  const Vec3 e0 = other.cross(std::abs(other.z()) < 0.8 * other.norm() ? Vec3::UnitZ() : Vec3::UnitX()).normalized();
  const Vec3 e1 = other.cross(e0).normalized();
  struct Row {
    double c, s, lambda, one;
  };
  const auto row = [&](const Vec3& e) {
    return Row{e.x() * step.x() + e.y() * step.y(), e.y() * step.x() - e.x() * step.y(), e.dot(ray), e.z() * step.z()};
  };
  const Row a = row(e0), b = row(e1);
  const double c = b.lambda * a.c - a.lambda * b.c, s = b.lambda * a.s - a.lambda * b.s;
  const double one = b.lambda * a.one - a.lambda * b.one, length = std::hypot(c, s);
  std::vector<Transform> poses;
  if (length < 1e-12 || std::abs(one) > length) return poses;
  for (const double side : {-1.0, 1.0}) {
    const double heading = std::atan2(s, c) + side * std::acos(-one / length);
    const Row& r = std::abs(a.lambda) > std::abs(b.lambda) ? a : b;
    const double depth = -(r.c * std::cos(heading) + r.s * std::sin(heading) + r.one) / r.lambda;
    const Quat q = base::FromYaw(heading);
    const Vec3 t = depth * ray - q * first;
    const Transform X_TS{(q_LT.conjugate() * q * q_LS).normalized(), q_LT.conjugate() * t};
    if (depth > 0 && X_TS.p.allFinite() && (X_TS * points[1].p).z() > 0) poses.push_back(X_TS);
  }
  return poses;
}

}  // namespace alula::stack::features
