#pragma once

#include <array>

#include "render/internal/scene_geometry.h"
#include "render/raster/packed_textures.h"

namespace alula::render::raster {

/// Planes of a triangle of `material` with the given vertices, whose corners are (column, row, depth): column / depth
/// and row / depth are its place. `about`: whole pixels, in the picture and near the triangle.
HolePlanes HolesOf(const internal::SceneGeometry& scene, const PackedTextures& alpha, std::size_t material,
                   const std::array<std::uint32_t, 3>& vertices, const std::array<base::Vec3, 3>& corners,
                   const base::Vec2& about);

}  // namespace alula::render::raster
