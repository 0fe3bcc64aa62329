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
/// 2¹⁵; rows of kShadowSide words, `pitch` apart. A word holds its texel in the low half and the one below it (the next
/// row's) in the high half, so that four neighbours are 64 bits that follow each other. Pushed away from the sun by 1.5
/// times its slope a texel against self-shadowing. The outermost texels stay empty.
struct ShadowMap {
  int pitch = 0;
  std::vector<std::uint32_t> words;

  std::int16_t At(int x, int y) const { return static_cast<std::int16_t>(words[Index(x, y)]); }
  void Set(int x, int y, std::int16_t distance);

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(pitch) + static_cast<std::size_t>(x);
  }
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
