#pragma once

#include <array>
#include <vector>

#include "base/frames.h"

namespace alula::vehicles {

/// A uniform quintic B-spline: four times continuously differentiable, inside the convex hull of its control points.
/// Segment i in [0, size − 5) depends on control points i … i+5; parameter u in [0, segments()].
template <typename Point>
class QuinticSpline {
 public:
  static constexpr int kDegree = 5;

  QuinticSpline() = default;
  explicit QuinticSpline(std::vector<Point> control) : control_(std::move(control)) {}

  double segments() const { return static_cast<double>(control_.size()) - kDegree; }

  /// The k-th derivative with respect to u, k in 0…4, at u clamped to its range. De Boor's algorithm on the k-th
  /// differences of the control points (uniform knots one apart).
  Point Derivative(double u, int k) const;

 private:
  std::vector<Point> control_;
};

/// The six basis functions that are not zero on a segment, and their derivatives by u, at t = u − segment in [0, 1]:
/// entry j weighs control point segment + j, which lies above u = segment + j − 2 (its Greville abscissa).
struct QuinticBasis {
  std::array<double, 6> value{};
  std::array<double, 6> slope{};
};
QuinticBasis QuinticBasisAt(double t);

template <typename Point>
Point QuinticSpline<Point>::Derivative(double u, int k) const {
  const double clamped = u < 0 ? 0.0 : (u > segments() ? segments() : u);
  int segment = static_cast<int>(clamped);
  if (segment == static_cast<int>(control_.size()) - kDegree) --segment;
  const double t = clamped - segment;
  Point d[kDegree + 1];
  for (int i = 0; i <= kDegree; ++i) d[i] = control_[static_cast<std::size_t>(segment + i)];
  for (int order = 0; order < k; ++order) {
    for (int i = 0; i < kDegree - order; ++i) d[i] = Point(d[i + 1] - d[i]);
  }
  const int p = kDegree - k;
  for (int r = 1; r <= p; ++r) {
    for (int i = p; i >= r; --i) {
      const double alpha = (t + p - i) / (p - r + 1);
      d[i] = Point((1 - alpha) * d[i - 1] + alpha * d[i]);
    }
  }
  return d[p];
}

}  // namespace alula::vehicles
