#include "render/raster/clipper.h"

#include <cmath>

#include "render/raster/kernels.h"

namespace alula::render::raster {
namespace {

/// Positive inside plane `number`: the near plane, then left, right, top and bottom of the guard band.
double Inside(const Corner& c, int number, double near) {
  constexpr double kReach = 0.5 * kGuard;  // px; well inside what the kernels take
  switch (number) {
    case 0:
      return c.depth - near;
    case 1:
      return c.column + kReach * c.depth;
    case 2:
      return kReach * c.depth - c.column;
    case 3:
      return c.row + kReach * c.depth;
    default:
      return kReach * c.depth - c.row;
  }
}

/// The point of an edge that lies on a plane, reckoned from the inner corner, whichever way the edge is walked.
Corner Cut(const Corner& inner, double inside, const Corner& outer, double outside) {
  const double share = inside / (inside - outside);
  Corner cut;
  cut.column = inner.column + share * (outer.column - inner.column);
  cut.row = inner.row + share * (outer.row - inner.row);
  cut.depth = inner.depth + share * (outer.depth - inner.depth);
  return cut;
}

}  // namespace

void ClipTriangle(const std::array<Corner, 3>& triangle, double near, std::vector<Corner>& polygon) {
  polygon.assign(triangle.begin(), triangle.end());
  std::vector<Corner> kept;
  for (int plane = 0; plane < 5; ++plane) {
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner& from = polygon[i];
      const Corner& to = polygon[(i + 1) % polygon.size()];
      const double a = Inside(from, plane, near);
      const double b = Inside(to, plane, near);
      if (a >= 0.0) kept.push_back(from);
      if (a >= 0.0 && b < 0.0) kept.push_back(Cut(from, a, to, b));
      if (a < 0.0 && b >= 0.0) kept.push_back(Cut(to, b, from, a));
    }
    polygon.swap(kept);
  }
  for (Corner& c : polygon) {
    if (c.snapped) continue;
    constexpr double kSubPixels = 1 << kSubPixelBits;
    c.x = static_cast<std::int32_t>(std::lround(c.column / c.depth * kSubPixels));
    c.y = static_cast<std::int32_t>(std::lround(c.row / c.depth * kSubPixels));
    c.snapped = true;
  }
}

}  // namespace alula::render::raster
