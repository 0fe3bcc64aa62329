#include "render/raster/visibility_buffer.h"

#include <algorithm>

namespace alula::render::raster {

Target VisibilityBuffer::Clear(int width, int height, float inverse_depth, bool with_ids) {
  Target target{};
  target.width = width;
  target.height = height;
  target.tiles_x = (width + kTile - 1) / kTile;
  target.tiles_y = (height + kTile - 1) / kTile;
  const std::size_t tiles = static_cast<std::size_t>(target.tiles_x) * static_cast<std::size_t>(target.tiles_y);
  const std::size_t pixels = tiles * kTile * kTile;
  inverse_depth_.resize(std::max(inverse_depth_.size(), pixels));
  std::fill_n(inverse_depth_.begin(), pixels, inverse_depth);
  tile_farthest_.assign(tiles, inverse_depth);
  tile_age_.assign(tiles, 0);
  if (with_ids) {
    ids_.resize(std::max(ids_.size(), pixels));
    std::fill_n(ids_.begin(), pixels, 0U);
  }
  target.inverse_depth = inverse_depth_.data();
  target.ids = with_ids ? ids_.data() : nullptr;
  target.tile_farthest = tile_farthest_.data();
  target.tile_age = tile_age_.data();
  return target;
}

}  // namespace alula::render::raster
