#include "stack/features/stereo_rig.h"

#include "base/error.h"

namespace alula::stack::features {

using base::Vec2;
using base::Vec3;

StereoRig MakeRig(const Calibration& calibration) {
  if (!calibration.stereo) throw base::InputError("calibration: no stereo pair; stereo odometry needs one");
  const CameraCalibration& left = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[0]));
  const CameraCalibration& right = calibration.cameras.at(static_cast<std::size_t>((*calibration.stereo)[1]));
  return {left.intrinsics, right.intrinsics, left.X_BC.Inverse() * right.X_BC, DepthSource::kStereo};
}

StereoRig MakeRig(const CameraCalibration& camera, std::optional<double> virtual_baseline) {
  StereoRig rig;
  rig.left = rig.right = camera.intrinsics;
  rig.right.distortion = {};
  rig.right.model = DistortionModel::kRadialTangential;
  rig.X_LR.p = Vec3(virtual_baseline.value_or(0.0), 0.0, 0.0);
  rig.depth = virtual_baseline ? DepthSource::kDepthCamera : DepthSource::kNone;
  return rig;
}

Vec2 VirtualRight(const StereoRig& rig, const Vec2& left, double depth) {
  return {left.x() - rig.X_LR.p.x() / depth, left.y()};
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
