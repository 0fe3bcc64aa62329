#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace alula::render::raster {

/// A corner in homogeneous image coordinates: column/depth and row/depth are pixels; snapped to 1/256 px where that is
/// known already, so that clipped triangles meet their whole neighbours without a gap.
struct Corner {
  double column = 0.0;
  double row = 0.0;
  double depth = 0.0;
  bool snapped = false;
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// The part of a triangle that lies beyond `near` (m) and inside the guard band, as a convex polygon whose corners are
/// snapped; empty where nothing is left (Sutherland and Hodgman 1974). Two triangles with a common edge are cut at the
/// same points of it.
void ClipTriangle(const std::array<Corner, 3>& triangle, double near, std::vector<Corner>& polygon);

}  // namespace alula::render::raster
