#include "render/raster/occlusion.h"

#include <algorithm>

namespace alula::render::raster {
namespace {

/// Rectangle of pixels (inclusive) and nearest depth of a box; false where it reaches too near to have a rectangle.
struct Outline {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;  // px
  double nearest = 1e9;                                       // m
};

bool OutlineOf(const internal::Batch& batch, const std::array<float, 12>& m, Outline& outline) {
  constexpr double kTooNear = 0.1;  // m
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector4d p((corner & 1) != 0 ? batch.high.x() : batch.low.x(),
                            (corner & 2) != 0 ? batch.high.y() : batch.low.y(),
                            (corner & 4) != 0 ? batch.high.z() : batch.low.z(), 1.0);
    const auto row = [&](std::size_t i) { return m[i] * p[0] + m[i + 1] * p[1] + m[i + 2] * p[2] + m[i + 3]; };
    const double depth = row(8);
    if (depth < kTooNear) return false;
    outline.nearest = std::min(outline.nearest, depth);
    outline.left = std::min(outline.left, row(0) / depth);
    outline.right = std::max(outline.right, row(0) / depth);
    outline.top = std::min(outline.top, row(4) / depth);
    outline.bottom = std::max(outline.bottom, row(4) / depth);
  }
  return true;
}

int TileAt(double pixel, int tiles) { return static_cast<int>(std::clamp(pixel / kTile, 0.0, tiles - 1.0)); }

}  // namespace

bool IsHidden(const internal::Batch& batch, const std::array<float, 12>& m, const Target& target) {
  constexpr double kRounding = 1.0 + 1e-5;  // single precision of the vertices' depth
  Outline outline;
  if (!OutlineOf(batch, m, outline)) return false;
  const auto inverse_depth = static_cast<float>(kRounding / outline.nearest);
  const int first = TileAt(outline.left - 1.0, target.tiles_x);
  const int last = TileAt(outline.right + 1.0, target.tiles_x);
  const int bottom = TileAt(outline.bottom + 1.0, target.tiles_y);
  for (int y = TileAt(outline.top - 1.0, target.tiles_y); y <= bottom; ++y) {
    const float* farthest = target.tile_farthest + y * target.tiles_x;
    for (int x = first; x <= last; ++x) {
      if (inverse_depth >= farthest[x]) return false;
    }
  }
  return true;
}

}  // namespace alula::render::raster
