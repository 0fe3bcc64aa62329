#include "render/internal/sky.h"

namespace alula::render::internal {
Eigen::Vector3f Luma(const Eigen::Vector3f& rgb) {
  return Eigen::Vector3f::Constant(0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2]);
}

SkyColours SkyOf(const worlds::Light& light, int channels, float brightness) {
  SkyColours colours{light.sky, 0.45F * light.sky + Eigen::Vector3f::Constant(0.52F),
                     0.35F * light.sky + Eigen::Vector3f::Constant(0.1F)};
  for (Eigen::Vector3f* colour : {&colours.zenith, &colours.horizon, &colours.ground})
    *colour *= brightness * light.sky_brightness;
  return channels == 1 ? SkyColours{Luma(colours.zenith), Luma(colours.horizon), Luma(colours.ground)} : colours;
}

}  // namespace alula::render::internal
