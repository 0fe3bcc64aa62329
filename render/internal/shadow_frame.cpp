#include "render/internal/shadow_frame.h"

#include <algorithm>
#include <cmath>

namespace alula::render::internal {

namespace {

/// As the sun sees them: `low` and `high` across the light, [far_low, far_high] along it.
ShadowFrame FrameBoxes(const base::Vec3& to_sun_W, const base::Vec3& low, const base::Vec3& high,
                       const base::Vec3& far_low, const base::Vec3& far_high) {
  const base::Vec3 z = to_sun_W.normalized();
  const base::Vec3 x = (std::abs(z.z()) < 0.99 ? base::Vec3::UnitZ() : base::Vec3::UnitY()).cross(z).normalized();
  base::Mat3 R_SW;
  R_SW << x.transpose(), z.cross(x).transpose(), z.transpose();

  base::Vec3 near_S = base::Vec3::Constant(1e9);
  base::Vec3 far_S = base::Vec3::Constant(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const base::Vec3 p((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                       (corner & 4) != 0 ? high.z() : low.z());
    const base::Vec3 q((corner & 1) != 0 ? far_high.x() : far_low.x(), (corner & 2) != 0 ? far_high.y() : far_low.y(),
                       (corner & 4) != 0 ? far_high.z() : far_low.z());
    base::Vec3 p_S = R_SW * p;
    p_S.z() = (R_SW * q).z();
    near_S = near_S.cwiseMin(p_S);
    far_S = far_S.cwiseMax(p_S);
  }
  constexpr double kMargin = 0.05;  // m along the light, so that nothing lies on the ends of the depth range
  constexpr double kRim = 1.0 + 4.0 / kShadowSide;
  const base::Vec3 middle = 0.5 * (near_S + far_S);
  base::Vec3 extent = (far_S - near_S).cwiseMax(1e-3);
  extent.head<2>() *= kRim;
  extent.z() += 2.0 * kMargin;

  const base::Vec3 flip(1.0, 1.0, -1.0);  // depth grows away from the sun
  const base::Vec3 scale = flip.cwiseQuotient(extent);
  ShadowFrame frame;
  frame.texel = std::max(extent.x(), extent.y()) / kShadowSide;
  frame.texture_from_world = Eigen::Matrix4d::Identity();
  frame.texture_from_world.topLeftCorner<3, 3>() = scale.asDiagonal() * R_SW;
  frame.texture_from_world.topRightCorner<3, 1>() = base::Vec3::Constant(0.5) - scale.cwiseProduct(middle);
  frame.clip_from_world = 2.0 * frame.texture_from_world;
  frame.clip_from_world.topRightCorner<3, 1>() -= base::Vec3::Ones();
  frame.clip_from_world(3, 3) = 1.0;
  return frame;
}

}  // namespace

ShadowFrame FrameShadow(const base::Vec3& to_sun_W, const base::Vec3& low, const base::Vec3& high) {
  return FrameBoxes(to_sun_W, low, high, low, high);
}

ShadowFrame FrameShadow(const worlds::World& world, const Eigen::Vector3f& statics_low,
                        const Eigen::Vector3f& statics_high) {
  constexpr double kBeyond = 3.0;  // m
  base::Vec3 low = statics_low.cast<double>();
  base::Vec3 high = statics_high.cast<double>();
  if ((world.bounds_high - world.bounds_low).minCoeff() > 0.0) {
    low.head<2>() = low.head<2>().cwiseMax((world.bounds_low.head<2>().array() - kBeyond).matrix()).eval();
    high.head<2>() = high.head<2>().cwiseMin((world.bounds_high.head<2>().array() + kBeyond).matrix()).eval();
  }
  high = high.cwiseMax(low).eval();
  // Along the light the frame reaches over all statics: land beyond the bounds that lay behind the frame's far end
  // would be dark, and what stands before its near end would cast no shadow.
  return FrameBoxes(world.light.to_sun_W, low, high, low.cwiseMin(statics_low.cast<double>()),
                    high.cwiseMax(statics_high.cast<double>()));
}

ShadowRegion RegionOf(const Eigen::Matrix4d& texture_from_box, const Eigen::Vector3f& low,
                      const Eigen::Vector3f& high) {
  base::Vec2 first = base::Vec2::Constant(1e9);
  base::Vec2 last = base::Vec2::Constant(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f p((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                            (corner & 4) != 0 ? high.z() : low.z());
    const base::Vec2 at = (texture_from_box * p.cast<double>().homogeneous()).head<2>() * kShadowSide;
    first = first.cwiseMin(at);
    last = last.cwiseMax(at);
  }
  const auto texel = [](double at, int beyond) {
    return static_cast<int>(std::clamp(std::floor(at) + beyond, 0.0, static_cast<double>(kShadowSide)));
  };
  return {std::max(texel(first.x(), -1), 1), std::max(texel(first.y(), -1), 1),
          std::min(texel(last.x(), 1), kShadowSide - 2), std::min(texel(last.y(), 1), kShadowSide - 2)};
}

}  // namespace alula::render::internal
