#pragma once

#include <Eigen/Core>

#include "worlds/world.h"

namespace alula::render::internal {

inline constexpr int kShadowSide = 2048;            // texels a side of the static shadow map
inline constexpr float kShadowNormalOffset = 1.5F;  // texels along the normal, for the look-up

/// The sun's own orthographic camera.
struct ShadowFrame {
  Eigen::Matrix4d texture_from_world;  // to [0, 1]³; the third coordinate grows away from the sun
  Eigen::Matrix4d clip_from_world;     // the same in [−1, 1]³
  double texel = 0.0;                  // size of a texel across the light, m (the larger side)
};

/// Frames what casts or takes shadows: the box [low, high] (m, world axes) as the sun sees it, with a rim of two
/// texels.
ShadowFrame FrameShadow(const base::Vec3& to_sun_W, const base::Vec3& low, const base::Vec3& high);

/// The same for the statics' box: the world's own bounds where they are given (shadows beyond them do not matter),
/// grown so that walls which stand on the bounds cast whole shadows; else all that stands in it.
ShadowFrame FrameShadow(const worlds::World& world, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

/// Texels that the shadow of a box may fall into, inclusive; the map's rim is left out. Empty where x1 < x0.
struct ShadowRegion {
  int x0 = 0;
  int y0 = 0;
  int x1 = -1;
  int y1 = -1;
  bool IsEmpty() const { return x1 < x0 || y1 < y0; }
};
/// `texture_from_box`: from the box's axes to the frame's texture.
ShadowRegion RegionOf(const Eigen::Matrix4d& texture_from_box, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

}  // namespace alula::render::internal
