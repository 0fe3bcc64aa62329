#include "stack/mapping/clearance_field.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::mapping {

namespace {

/// The eight cell centres about a point and where the point lies between them; points outside are moved to the edge.
struct Corners {
  std::size_t index[2][2][2];
  double t[3];
};

Corners CornersAbout(const GridShape& shape, const base::Vec3& p_O) {
  int low[3];
  int high[3];
  Corners c;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = shape.size[axis] - 1;
    const double g = std::clamp((p_O[axis] - shape.low_O[axis]) / shape.cell - 0.5, 0.0, last);
    low[axis] = static_cast<int>(g);
    high[axis] = std::min(low[axis] + 1, shape.size[axis] - 1);
    c.t[axis] = g - low[axis];
  }
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      for (int e = 0; e < 2; ++e) {
        c.index[a][b][e] = shape.Index(a ? high[0] : low[0], b ? high[1] : low[1], e ? high[2] : low[2]);
      }
    }
  }
  return c;
}

double Mix(double a, double b, double t) { return a + (b - a) * t; }

double Trilinear(const Corners& c, const std::vector<std::uint8_t>& field) {
  double plane[2];
  for (int a = 0; a < 2; ++a) {
    const double low = Mix(field[c.index[a][0][0]], field[c.index[a][0][1]], c.t[2]);
    const double high = Mix(field[c.index[a][1][0]], field[c.index[a][1][1]], c.t[2]);
    plane[a] = Mix(low, high, c.t[1]);
  }
  return Mix(plane[0], plane[1], c.t[0]);
}

}  // namespace

std::array<int, 3> GridShape::CellOf(const base::Vec3& p_O) const {
  std::array<int, 3> index;
  for (int axis = 0; axis < 3; ++axis) {
    // Far points are clamped (to just outside) so that the conversion to int is defined. The floor is taken by hand:
    // without SSE 4.1 the library's is a call, and this runs for every pixel.
    const double g = std::clamp((p_O[axis] - low_O[axis]) / cell, -1.0, static_cast<double>(size[axis]));
    const int towards_zero = static_cast<int>(g);
    index[axis] = towards_zero > g ? towards_zero - 1 : towards_zero;
  }
  return index;
}

CellState ClearanceField::State(const base::Vec3& p_O) const {
  const auto [i, j, k] = shape.CellOf(p_O);
  return shape.Contains(i, j, k) ? StateOf(shape.Index(i, j, k)) : CellState::kUnknown;
}

double ClearanceField::Clearance(const base::Vec3& p_O) const {
  return step() * Trilinear(CornersAbout(shape, p_O), to_occupied);
}

double ClearanceField::KnownFreeClearance(const base::Vec3& p_O) const {
  const auto [i, j, k] = shape.CellOf(p_O);
  if (!shape.Contains(i, j, k)) return 0.0;
  return step() * Trilinear(CornersAbout(shape, p_O), to_not_free);
}

base::Vec3 ClearanceField::ClearanceGradient(const base::Vec3& p_O) const {
  base::Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const base::Vec3 half = 0.5 * shape.cell * base::Vec3::Unit(axis);
    gradient[axis] = (Clearance(p_O + half) - Clearance(p_O - half)) / shape.cell;
  }
  return gradient;
}

}  // namespace alula::stack::mapping
