#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/material.h"
#include "render/internal/texture_levels.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// The mip chains of all materials for one kind of picture, laid out as TextureView says.
struct PackedTextures {
  std::vector<TextureView> views;  // one a material
  std::array<std::vector<std::uint16_t>, 3> words;
};

/// Throws base::FaultError as TextureLevels does.
PackedTextures PackTextures(std::span<const geometry::Material> materials, internal::TextureKind kind);

/// Alpha of the materials that have holes; the others' views are empty.
PackedTextures PackAlpha(std::span<const geometry::Material> materials);

}  // namespace alula::render::raster
