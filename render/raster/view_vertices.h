#pragma once

#include <vector>

#include "render/raster/kernels.h"

namespace alula::render::raster {

/// Memory of the vertices that a view sees.
class ViewVertices {
 public:
  explicit ViewVertices(std::size_t count) : floats_(4 * count), integers_(3 * count) {
    float* f = floats_.data();
    std::int32_t* i = integers_.data();
    arrays_ = {f, f + count, f + 2 * count, f + 3 * count, i, i + count, i + 2 * count};
  }
  const Vertices& arrays() const { return arrays_; }

 private:
  std::vector<float> floats_;
  std::vector<std::int32_t> integers_;
  Vertices arrays_{};
};

}  // namespace alula::render::raster
