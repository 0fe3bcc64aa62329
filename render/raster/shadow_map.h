#pragma once

#include <vector>

#include "render/internal/shadow_frame.h"
#include "render/raster/packed_textures.h"
#include "render/raster/raster_scene.h"

namespace alula::render::raster {

/// Distance from the sun of what it sees first, in 1/65535 of the frame's depth (65535: nothing): kShadowSide² words in
/// Morton order, texel (x, y) in the low half and (x, y + 1) in the high half. Pushed away from the sun by 1.5 times
/// its slope a texel against self-shadowing. The outermost texels stay empty. Both faces cast.
class ShadowMap {
 public:
  /// Draws the statics' shadows.
  ShadowMap(const RasterScene& scene, const internal::ShadowFrame& frame, const PackedTextures& alpha,
            const Kernels& kernels);

  /// The movers have been placed anew.
  void MoversMoved() { is_current_ = false; }
  /// The map with the movers where they stand now: where one has been or is, it is drawn anew, and nowhere else.
  const std::uint32_t* Words(const RasterScene& scene, const internal::ShadowFrame& frame, const PackedTextures& alpha,
                             const Kernels& kernels);

 private:
  std::vector<std::uint32_t> words_;
  std::vector<std::uint32_t> statics_;  // without movers; empty where there are none
  std::vector<internal::ShadowRegion> regions_;
  bool is_current_ = false;
};

}  // namespace alula::render::raster
