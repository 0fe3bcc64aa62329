#include "render/internal/projection.h"

#include <string>

#include "base/error.h"

namespace alula::render::internal {

void CheckView(const View& view) {
  constexpr int kLargest = 8192;
  constexpr float kBrightest = 1e6F;
  const stack::CameraIntrinsics& k = view.intrinsics;
  if (k.width < 1 || k.height < 1 || k.width > kLargest || k.height > kLargest) {
    throw base::InputError("camera of " + std::to_string(k.width) + " x " + std::to_string(k.height) +
                           " pixels; each side must be in [1, 8192]");
  }
  if (!(k.fx > 0.0) || !(k.fy > 0.0)) throw base::InputError("camera: focal lengths must be positive");
  if (!(view.brightness >= 0.0F && view.brightness <= kBrightest)) {
    throw base::InputError("camera: brightness is " + std::to_string(view.brightness) + "; it must be in [0, 1e6]");
  }
  if (view.lamps.size() > kMostViewLamps) {
    throw base::InputError("camera: " + std::to_string(view.lamps.size()) + " lamps ride on it; at most 8 are drawn");
  }
  for (const worlds::Lamp& lamp : view.lamps) worlds::Check(lamp, "camera");
  for (const double coefficient : k.distortion) {
    if (coefficient != 0.0)
      throw base::InputError("camera: lens distortion is not rendered; all coefficients must be 0");
  }
}

Eigen::Matrix4d ClipFromWorld(const View& view) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  Eigen::Matrix4d clip_from_camera = Eigen::Matrix4d::Zero();
  clip_from_camera(0, 0) = 2.0 * k.fx / k.width;
  clip_from_camera(0, 2) = 2.0 * (k.cx + 0.5) / k.width - 1.0;
  clip_from_camera(1, 1) = 2.0 * k.fy / k.height;
  clip_from_camera(1, 2) = 2.0 * (k.cy + 0.5) / k.height - 1.0;
  clip_from_camera(2, 2) = (kFar + kNear) / (kFar - kNear);
  clip_from_camera(2, 3) = -2.0 * kFar * kNear / (kFar - kNear);
  clip_from_camera(3, 2) = 1.0;

  const base::Transform X_CW = view.X_WC.Inverse();
  Eigen::Matrix4d camera_from_world = Eigen::Matrix4d::Identity();
  camera_from_world.topLeftCorner<3, 3>() = X_CW.R();
  camera_from_world.topRightCorner<3, 1>() = X_CW.p;
  return clip_from_camera * camera_from_world;
}

base::Vec3 RayDirection(const View& view, double u, double v) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  return view.X_WC.q * base::Vec3((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1.0);
}

Frustum FrustumOf(const Eigen::Matrix4d& clip_from_world) {
  Frustum frustum;
  const Eigen::RowVector4d w = clip_from_world.row(3);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(2 * axis);
    frustum[i] = (w + clip_from_world.row(axis)).transpose();
    frustum[i + 1] = (w - clip_from_world.row(axis)).transpose();
  }
  return frustum;
}

bool MayBeVisible(const Frustum& frustum, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  for (const Eigen::Vector4d& plane : frustum) {
    // The corner that lies farthest along the plane's normal.
    double reach = plane[3];
    for (int i = 0; i < 3; ++i) reach += plane[i] * static_cast<double>(plane[i] > 0.0 ? high[i] : low[i]);
    if (reach < 0.0) return false;
  }
  return true;
}

}  // namespace alula::render::internal
