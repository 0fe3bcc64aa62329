#include "stack/features/camera_model.h"

#include <Eigen/LU>

#include "base/error.h"

namespace alula::stack::features {
namespace {

using base::Vec2;
using base::Vec3;

bool IsPinhole(const CameraIntrinsics& camera) {
  for (const double k : camera.distortion) {
    if (k != 0.0) return false;
  }
  return true;
}

struct Distorted {
  Vec2 point;
  Eigen::Matrix2d jacobian;
};

Distorted DistortWithJacobian(const CameraIntrinsics& camera, const Vec2& n) {
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

}  // namespace

Vec2 Distort(const CameraIntrinsics& camera, const Vec2& normalised) {
  return IsPinhole(camera) ? normalised : DistortWithJacobian(camera, normalised).point;
}

Vec2 Normalise(const CameraIntrinsics& camera, const Vec2& pixel) {
  const Vec2 distorted((pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy);
  if (IsPinhole(camera)) return distorted;
  Vec2 n = distorted;
  for (int i = 0; i < 10; ++i) {  // converges quadratically; real lenses need four
    const Distorted d = DistortWithJacobian(camera, n);
    const Vec2 step = d.jacobian.inverse() * (distorted - d.point);
    n += step;
    if (step.squaredNorm() < 1e-24) break;
  }
  return n;
}

Vec2 Project(const CameraIntrinsics& camera, const Vec3& p_C) {
  const Vec2 d = Distort(camera, p_C.head<2>() / p_C.z());
  return {camera.fx * d.x() + camera.cx, camera.fy * d.y() + camera.cy};
}

bool Inside(const CameraIntrinsics& camera, const Vec2& pixel, double border) {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() <= camera.width - 1 - border &&
         pixel.y() <= camera.height - 1 - border;
}

StereoRig MakeRig(const Calibration& calibration) {
  if (!calibration.stereo) throw base::InputError("calibration: no stereo pair; stereo odometry needs one");
  const CameraCalibration& left = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[0]));
  const CameraCalibration& right = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[1]));
  return {left.intrinsics, right.intrinsics, left.X_BC.Inverse() * right.X_BC};
}

double TriangulatedDepth(const base::Transform& X_LR, const Vec2& left, const Vec2& right) {
  // z_l a − z_r b = p with a, b the rays in the left frame: least squares in (z_l, z_r).
  const Vec3 a = left.homogeneous();
  const Vec3 b = X_LR.q * Vec3(right.homogeneous());
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b);
  const double determinant = aa * bb - ab * ab;
  if (determinant < 1e-14) return -1.0;  // parallel rays
  return (bb * a.dot(X_LR.p) - ab * b.dot(X_LR.p)) / determinant;
}

}  // namespace alula::stack::features
