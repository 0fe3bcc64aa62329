#pragma once

#include <vector>

#include "render/internal/shadow_frame.h"
#include "render/raster/packed_textures.h"
#include "render/raster/raster_scene.h"

namespace alula::render::raster {

/// Distance from the sun of what it sees first of the statics, in 1/65535 of the frame's depth (65535: nothing):
/// kShadowSide² words in Morton order, texel (x, y) in the low half and (x, y + 1) in the high half. Pushed away from
/// the sun by 1.5 times its slope a texel against self-shadowing. The outermost texels stay empty. Both faces cast.
std::vector<std::uint32_t> DrawShadowMap(const RasterScene& scene, const internal::ShadowFrame& frame,
                                         const PackedTextures& alpha, const Kernels& kernels);

}  // namespace alula::render::raster
