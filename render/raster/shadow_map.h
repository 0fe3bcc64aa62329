#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/internal/scene_geometry.h"
#include "render/raster/kernels.h"
#include "render/raster/packed_textures.h"
#include "render/raster/visibility_buffer.h"

namespace alula::render::raster {

/// Distance from the sun of what it sees first of the statics, in 1/65535 of the frame's depth (65535: nothing), less
/// 2¹⁵; rows of kShadowSide texels, `pitch` apart. Pushed away from the sun by 1.5 times its slope a texel against
/// self-shadowing. The outermost texels stay empty.
struct ShadowMap {
  int pitch = 0;
  std::vector<std::uint16_t> words;
};

/// Draws the full levels of all statics; both faces cast.
ShadowMap DrawShadowMap(const internal::SceneGeometry& scene, const PackedTextures& alpha, const Kernels& kernels);

/// A map of one's own with the movers' shadows in it: where one has been or is it is drawn anew, and nowhere else.
class MoverShadows {
 public:
  /// The movers stand at X_WM, in their order.
  const ShadowMap& Place(const internal::SceneGeometry& scene, const ShadowMap& statics, const PackedTextures& alpha,
                         const Kernels& kernels, std::span<const base::Transform> X_WM);
  /// Where the movers' shadows lie.
  const std::vector<internal::ShadowRegion>& regions() const { return regions_; }

 private:
  ShadowMap map_;
  std::vector<internal::ShadowRegion> regions_;
  VisibilityBuffer buffer_;  // of one mover
};

}  // namespace alula::render::raster
