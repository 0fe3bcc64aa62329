#pragma once

#include "worlds/world.h"

namespace alula::render::internal {

/// Colours that the sky runs through, displayed values in [0, 1] (channels 1: luma in all three places).
struct SkyColours {
  Eigen::Vector3f zenith;
  Eigen::Vector3f horizon;
  Eigen::Vector3f ground;  // below the horizon
};
/// `brightness`: a factor on all of them, beside the light's own.
SkyColours SkyOf(const worlds::Light& light, int channels, float brightness);

/// Luma in all three places (ITU-R BT.601).
Eigen::Vector3f Luma(const Eigen::Vector3f& rgb);

}  // namespace alula::render::internal
