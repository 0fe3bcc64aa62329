#pragma once

#include <vector>

#include "render/raster/kernels.h"

namespace alula::render::raster {

/// Memory of a Target; grows to the largest picture asked for.
class VisibilityBuffer {
 public:
  /// An empty target: nothing is drawn that is not nearer than `inverse_depth` (1/m).
  Target Clear(int width, int height, float inverse_depth, bool with_ids);

 private:
  std::vector<float> inverse_depth_;
  std::vector<std::uint32_t> ids_;
  std::vector<float> tile_farthest_;
  std::vector<std::int32_t> tile_age_;
};

}  // namespace alula::render::raster
