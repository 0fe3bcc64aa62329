#include "stack/mapping/internal/rectification.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::mapping::internal {

namespace {

void MakeMaps(const Rectification& r, const CameraCalibration& camera, cv::Mat& map1, cv::Mat& map2) {
  const base::Mat3 R_KC = (camera.X_BC.q.conjugate() * r.X_BC.q).toRotationMatrix();  // rectified → physical
  cv::Mat x(r.height, r.width, CV_32FC1);
  cv::Mat y(r.height, r.width, CV_32FC1);
  for (int v = 0; v < r.height; ++v) {
    for (int u = 0; u < r.width; ++u) {
      const base::Vec3 ray_C((u - r.cx) / r.focal, (v - r.cy) / r.focal, 1.0);
      const base::Vec2 pixel = Project(camera.intrinsics, R_KC * ray_C);
      x.at<float>(v, u) = static_cast<float>(pixel.x());
      y.at<float>(v, u) = static_cast<float>(pixel.y());
    }
  }
  cv::convertMaps(x, y, map1, map2, CV_16SC2);
}

}  // namespace

Rectification MakeRectification(const Calibration& calibration) {
  if (!calibration.stereo) throw base::InputError("calibration: stereo depth needs a stereo pair; name its two eyes");
  const CameraCalibration& left = calibration.cameras.at((*calibration.stereo)[0]);
  const CameraCalibration& right = calibration.cameras.at((*calibration.stereo)[1]);
  const CameraIntrinsics& kl = left.intrinsics;
  const CameraIntrinsics& kr = right.intrinsics;
  if (kl.width != kr.width || kl.height != kr.height || kl.width < 64 || kl.height < 64) {
    throw base::InputError("calibration: the two eyes of the stereo pair must have one size of at least 64 pixels");
  }
  const base::Vec3 baseline_B = right.X_BC.p - left.X_BC.p;
  const base::Vec3 x = baseline_B.normalized();
  if (!(baseline_B.norm() > 1e-3) || x.dot(left.X_BC.q * base::Vec3::UnitX()) < 0.9) {
    throw base::InputError("calibration: the right eye must stand to the right of the left one");
  }
  const base::Vec3 axes = left.X_BC.q * base::Vec3::UnitZ() + right.X_BC.q * base::Vec3::UnitZ();
  const base::Vec3 z = (axes - x * x.dot(axes)).normalized();
  base::Mat3 R_BC;
  R_BC << x, z.cross(x), z;

  Rectification r;
  r.X_BC = {base::Quat(R_BC), left.X_BC.p};
  r.baseline = baseline_B.norm();
  r.focal = 0.25 * (kl.fx + kl.fy + kr.fx + kr.fy);
  r.cx = 0.5 * (kl.cx + kr.cx);
  r.cy = 0.5 * (kl.cy + kr.cy);
  r.width = kl.width & ~1;
  r.height = kl.height & ~1;
  MakeMaps(r, left, r.left_map1, r.left_map2);
  MakeMaps(r, right, r.right_map1, r.right_map2);
  return r;
}

}  // namespace alula::stack::mapping::internal
