#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/material.h"
#include "render/internal/texture_levels.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// The mip chains of all materials for one kind of picture, 2×2 texels a word (t(x, y), t(x, y+1), t(x+1, y),
/// t(x+1, y+1), lowest byte first; wrapped), so that a bilinear sample is one load.
struct PackedTextures {
  std::vector<TextureView> views;  // one a material
  std::array<std::vector<std::uint32_t>, 3> words;
};

/// Throws base::FaultError as TextureLevels does.
PackedTextures PackTextures(std::span<const geometry::Material> materials, internal::TextureKind kind);

/// Alpha of the materials that have holes; the others' views are empty.
PackedTextures PackAlpha(std::span<const geometry::Material> materials);

}  // namespace alula::render::raster
