#pragma once

#include <array>

#include "render/internal/scene_geometry.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// Whether everything inside the batch's box lies behind what is drawn already: its rectangle in the picture and its
/// nearest corner against the tiles' bounds. `m`: (column, row, depth) = m · (p_W, 1), row by row.
bool IsHidden(const internal::Batch& batch, const std::array<float, 12>& m, const Target& target);

}  // namespace alula::render::raster
