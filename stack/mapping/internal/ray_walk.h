#pragma once

#include <cmath>
#include <limits>

#include "stack/mapping/clearance_field.h"

namespace alula::stack::mapping::internal {

/// The part of the segment from → to inside the grid; false when there is none. The ends are moved onto the grid's
/// faces, a hair inside.
inline bool ClipToGrid(const GridShape& shape, base::Vec3& from_O, base::Vec3& to_O) {
  double enter = 0.0;
  double leave = 1.0;
  const base::Vec3 d = to_O - from_O;
  const base::Vec3 low = shape.low_O + base::Vec3::Constant(1e-9);
  const base::Vec3 high = shape.high_O() - base::Vec3::Constant(1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (from_O[axis] < low[axis] || from_O[axis] > high[axis]) return false;
      continue;
    }
    const double a = (low[axis] - from_O[axis]) / d[axis];
    const double b = (high[axis] - from_O[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return false;
  const base::Vec3 start = from_O;
  if (enter > 0.0) from_O = (start + enter * d).cwiseMax(low).cwiseMin(high);
  if (leave < 1.0) to_O = (start + leave * d).cwiseMax(low).cwiseMin(high);
  return true;
}

/// Calls visit(index) for every cell that the segment crosses, from the first to the last, both included. Both ends
/// lie inside the grid. (Amanatides and Woo 1987)
template <typename Visit>
void WalkRay(const GridShape& shape, const base::Vec3& from_O, const base::Vec3& to_O, Visit visit) {
  const auto first = shape.CellOf(from_O);
  const auto last = shape.CellOf(to_O);
  const base::Vec3 d = to_O - from_O;
  const std::ptrdiff_t strides[3] = {static_cast<std::ptrdiff_t>(shape.size[1]) * shape.size[2], shape.size[2], 1};
  double next[3];     // ray parameter of the next crossing, by axis
  double spacing[3];  // between crossings
  std::ptrdiff_t stride[3];
  int left[3];  // crossings still to make
  int total = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int direction = d[axis] > 0 ? 1 : -1;
    left[axis] = std::abs(last[axis] - first[axis]);
    total += left[axis];
    stride[axis] = direction * strides[axis];
    next[axis] = std::numeric_limits<double>::infinity();
    spacing[axis] = 0.0;
    if (left[axis] > 0) {
      const double face = shape.low_O[axis] + shape.cell * (first[axis] + (direction > 0 ? 1 : 0));
      next[axis] = (face - from_O[axis]) / d[axis];
      spacing[axis] = shape.cell / std::abs(d[axis]);
    }
  }
  std::ptrdiff_t index = static_cast<std::ptrdiff_t>(shape.Index(first[0], first[1], first[2]));
  visit(static_cast<std::size_t>(index));
  for (; total > 0; --total) {
    int axis = next[0] < next[1] ? 0 : 1;
    if (next[2] < next[axis]) axis = 2;
    index += stride[axis];
    // An axis that has made its crossings is out, so that the walk ends in the last cell whatever rounding does.
    next[axis] = --left[axis] > 0 ? next[axis] + spacing[axis] : std::numeric_limits<double>::infinity();
    visit(static_cast<std::size_t>(index));
  }
}

}  // namespace alula::stack::mapping::internal
