#include "render/internal/air_and_lamps.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "render/internal/sky.h"

namespace alula::render::internal {
namespace {

/// False only where the sphere lies wholly outside one of the planes.
bool MayReach(const Frustum& frustum, const base::Vec3& centre, double radius) {
  for (const Eigen::Vector4d& plane : frustum) {
    const Eigen::Vector3d normal = plane.head<3>();
    if (normal.dot(centre) + plane[3] < -radius * normal.norm()) return false;
  }
  return true;
}

LampView ViewOf(const worlds::Lamp& lamp, const base::Transform& X_WL, const View& view, int channels) {
  // What a picture shows is the root of light: its factor enters light squared.
  const float gain = static_cast<float>(lamp.intensity) * view.brightness * view.brightness;
  const Eigen::Vector3f colour = lamp.colour.cast<float>();
  const Eigen::Vector3f light = gain * (channels == 1 ? Luma(colour) : colour);
  const Eigen::Vector3f position = (X_WL * lamp.position).cast<float>();
  const Eigen::Vector3f direction = (X_WL.R() * lamp.direction.normalized()).cast<float>();
  LampView out;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.position[k] = position[i];
    out.direction[k] = direction[i];
    out.light[k] = light[i];
  }
  out.inverse_range_squared = static_cast<float>(1.0 / (lamp.range * lamp.range));
  const bool all_round = lamp.cone > std::numbers::pi - 1e-6;
  out.cone_cosine = all_round ? -4.0F : static_cast<float>(std::cos(lamp.cone));
  out.cone_scale = all_round ? 1.0F : static_cast<float>(1.0 / (lamp.softness * (1.0 - std::cos(lamp.cone))));
  return out;
}

}  // namespace

AirAndLamps AirAndLampsOf(const worlds::Light& light, const View& view, int channels) {
  AirAndLamps out;
  const Frustum frustum = FrustumOf(ClipFromWorld(view));
  for (const worlds::Lamp& lamp : light.lamps) {
    if (MayReach(frustum, lamp.position, lamp.range)) out.lamps.push_back(ViewOf(lamp, {}, view, channels));
  }
  for (const worlds::Lamp& lamp : view.lamps) out.lamps.push_back(ViewOf(lamp, view.X_WC, view, channels));
  if (!light.fog) return out;
  const double extinction = std::log(1.0 / 0.02) / light.fog->visibility;
  const Eigen::Vector3f colour = view.brightness * light.fog->colour.cast<float>();
  out.extinction = static_cast<float>(extinction);
  out.sky_depth = static_cast<float>(extinction * light.fog->height);
  out.fog = channels == 1 ? Luma(colour) : colour;
  return out;
}

void CheckLight(const worlds::Light& light) {
  if (light.lamps.size() > kMostWorldLamps) {
    throw base::InputError("the world has " + std::to_string(light.lamps.size()) + " lamps; at most " +
                           std::to_string(kMostWorldLamps) + " are drawn");
  }
  for (const worlds::Lamp& lamp : light.lamps) worlds::Check(lamp, "world");
  if (light.fog) worlds::Check(*light.fog, "world");
}

}  // namespace alula::render::internal
