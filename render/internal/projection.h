#pragma once

#include <Eigen/Core>
#include <array>

#include "render/camera_renderer.h"

namespace alula::render::internal {

inline constexpr double kNear = 0.05;  // m; nearer things are cut away
inline constexpr double kFar = 200.0;  // m
inline constexpr std::size_t kMostWorldLamps = 32;
inline constexpr std::size_t kMostViewLamps = 8;

/// Throws base::InputError unless the view has a size in [1, 8192]², positive focal lengths, no distortion, a
/// brightness that is not negative, and at most kMostViewLamps lamps that can be.
void CheckView(const View& view);

/// GL clip coordinates of a point of the world (homogeneous). The image spans [−½, width − ½] × [−½, height − ½];
/// y grows downwards in clip space, so that row 0 of the framebuffer is the top row of the image and front faces
/// appear clockwise. w is the depth along the optical axis, m.
Eigen::Matrix4d ClipFromWorld(const View& view);

/// Equal to the bit, so that a mover has not moved.
inline bool IsSame(const base::Transform& a, const base::Transform& b) {
  return a.q.coeffs() == b.q.coeffs() && a.p == b.p;
}

/// Direction in the world of the ray through pixel (u, v), with unit depth: z_C = 1.
base::Vec3 RayDirection(const View& view, double u, double v);

/// The six planes of a view: dot(plane, (p, 1)) >= 0 inside.
using Frustum = std::array<Eigen::Vector4d, 6>;
Frustum FrustumOf(const Eigen::Matrix4d& clip_from_world);

/// False only where the axis-aligned box lies wholly outside one of the planes.
bool MayBeVisible(const Frustum& frustum, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

}  // namespace alula::render::internal
