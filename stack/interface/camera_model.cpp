#include "stack/interface/camera_model.h"

#include <Eigen/LU>
#include <cmath>

namespace alula::stack {
namespace {

using base::Vec2;
using base::Vec3;

struct Distorted {
  Vec2 point;
  Eigen::Matrix2d jacobian;
};

Distorted RadialTangential(const CameraIntrinsics& camera, const Vec2& n) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = n.x(), y = n.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = k1 + r2 * (2 * k2 + r2 * 3 * k3);  // d radial / d r²
  Distorted d;
  d.point = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  d.jacobian << radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x, 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
      2 * x * y * slope + 2 * p1 * x + 2 * p2 * y, radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x;
  return d;
}

/// θ_d and its slope.
std::pair<double, double> Equidistant(const CameraIntrinsics& camera, double theta) {
  const auto& k = camera.distortion;
  const double t2 = theta * theta;
  return {theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))),
          1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])))};
}

double AngleOf(const CameraIntrinsics& camera, double theta_d) {
  double theta = theta_d;
  for (int i = 0; i < 20; ++i) {
    const auto [value, slope] = Equidistant(camera, theta);
    if (!(slope > 1e-6)) break;  // beyond the fold there is no answer
    const double step = (theta_d - value) / slope;
    theta += step;
    if (std::abs(step) < 1e-14) break;
  }
  return theta;
}

Vec2 OnSensor(const CameraIntrinsics& camera, const Vec2& distorted) {
  return {camera.fx * distorted.x() + camera.cx, camera.fy * distorted.y() + camera.cy};
}

Vec2 OffSensor(const CameraIntrinsics& camera, const Vec2& pixel) {
  return {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
}

Vec2 EquidistantOfRay(const CameraIntrinsics& camera, const Vec3& p) {
  const double across = p.head<2>().norm();
  if (across < 1e-12 * std::abs(p.z())) return p.head<2>() / std::abs(p.z());
  return p.head<2>() * (Equidistant(camera, std::atan2(across, p.z())).first / across);
}

}  // namespace

bool IsPinhole(const CameraIntrinsics& camera) {
  if (camera.model == DistortionModel::kEquidistant) return false;
  for (const double k : camera.distortion) {
    if (k != 0.0) return false;
  }
  return true;
}

Vec2 Distort(const CameraIntrinsics& camera, const Vec2& normalised) {
  if (camera.model == DistortionModel::kEquidistant) return EquidistantOfRay(camera, normalised.homogeneous());
  return IsPinhole(camera) ? normalised : RadialTangential(camera, normalised).point;
}

Vec2 Normalise(const CameraIntrinsics& camera, const Vec2& pixel) {
  const Vec2 distorted = OffSensor(camera, pixel);
  if (IsPinhole(camera)) return distorted;
  if (camera.model == DistortionModel::kEquidistant) return Ray(camera, pixel).hnormalized();
  Vec2 n = distorted;
  for (int i = 0; i < 10; ++i) {  // converges quadratically; real lenses need four
    const Distorted d = RadialTangential(camera, n);
    const Vec2 step = d.jacobian.inverse() * (distorted - d.point);
    n += step;
    if (step.squaredNorm() < 1e-24) break;
  }
  return n;
}

Vec3 Ray(const CameraIntrinsics& camera, const Vec2& pixel) {
  if (camera.model != DistortionModel::kEquidistant) return Normalise(camera, pixel).homogeneous().normalized();
  const Vec2 distorted = OffSensor(camera, pixel);
  const double theta_d = distorted.norm();
  if (theta_d < 1e-12) return Vec3::UnitZ();
  const double theta = AngleOf(camera, theta_d);
  Vec3 ray;
  ray << distorted * (std::sin(theta) / theta_d), std::cos(theta);
  return ray;
}

Vec2 Project(const CameraIntrinsics& camera, const Vec3& p_C) {
  if (camera.model == DistortionModel::kEquidistant) return OnSensor(camera, EquidistantOfRay(camera, p_C));
  return OnSensor(camera, Distort(camera, p_C.head<2>() / p_C.z()));
}

bool Inside(const CameraIntrinsics& camera, const Vec2& pixel, double border) {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() <= camera.width - 1 - border &&
         pixel.y() <= camera.height - 1 - border;
}

double LargestAngle(const CameraIntrinsics& camera) {
  constexpr double kStep = 1e-3;  // rad
  const bool fisheye = camera.model == DistortionModel::kEquidistant;
  const double end = fisheye ? M_PI : 0.5 * M_PI;
  const auto& k = camera.distortion;
  for (double theta = kStep; theta < end; theta += kStep) {
    if (fisheye) {
      if (!(Equidistant(camera, theta).second > 0.0)) return theta - kStep;
      continue;
    }
    const double r2 = std::tan(theta) * std::tan(theta);
    if (!(1 + r2 * (3 * k[0] + r2 * (5 * k[1] + r2 * 7 * k[4])) > 0.0)) return theta - kStep;
  }
  return M_PI;
}

}  // namespace alula::stack
