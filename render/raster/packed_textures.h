#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/material.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// The mip chains of all materials for one kind of picture, laid out as TextureView says.
struct PackedTextures {
  std::vector<TextureView> views;  // one a material
  std::array<std::vector<std::uint16_t>, 3> words;
};

/// `channels`: 1 (luma) or 3 (RGB). Throws base::FaultError as TextureLevels does.
PackedTextures PackTextures(std::span<const geometry::Material> materials, int channels);

}  // namespace alula::render::raster
