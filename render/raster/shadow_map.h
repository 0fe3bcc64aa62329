#pragma once

#include <cstdint>
#include <vector>

#include "render/internal/scene_geometry.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// Distance from the sun of what it sees first of the statics, in 1/65535 of the frame's depth (65535: nothing), less
/// 2¹⁵; rows of kShadowSide texels, `pitch` apart. Pushed away from the sun by 1.5 times its slope a texel against
/// self-shadowing. The outermost texels stay empty.
struct ShadowMap {
  int pitch = 0;
  std::vector<std::uint16_t> words;
};

/// Draws the full levels of all statics; both faces cast.
ShadowMap DrawShadowMap(const internal::SceneGeometry& scene, const Kernels& kernels);

}  // namespace alula::render::raster
