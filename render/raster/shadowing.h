#pragma once

#include <vector>

#include "render/raster/shadow_map.h"

namespace alula::render::raster {

/// What looks into the statics' shadow map would give, by triangle and, for large triangles, by block of the map
/// (kernels.h), so that most pixels need no look.
struct ShadowingTable {
  std::vector<std::uint32_t> of_triangle;
  std::vector<ShadowingGrid> grids;
  std::vector<Shadowing> blocks;
};

/// `attributes`: of the statics' vertices, kAttributes each. Movers' triangles are mixed.
ShadowingTable FindShadowing(const internal::SceneGeometry& scene, const std::vector<float>& attributes,
                             const ShadowMap& map);

}  // namespace alula::render::raster
