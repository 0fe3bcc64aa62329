#pragma once

#include <array>

#include "render/raster/packed_textures.h"
#include "render/raster/raster_scene.h"

namespace alula::render::raster {

/// Planes of triangle `number`, whose corners are (column, row, depth): column / depth and row / depth are its place.
/// `about`: whole pixels, in the picture and near the triangle.
HolePlanes HolesOf(const RasterScene& scene, const PackedTextures& alpha, std::uint32_t number,
                   const std::array<base::Vec3, 3>& corners, const base::Vec2& about);

}  // namespace alula::render::raster
