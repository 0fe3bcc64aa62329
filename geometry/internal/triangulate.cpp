#include "geometry/internal/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace alula::geometry::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Area vector of the polygon, times two (Newell 1972).
Vector3d Newell(const std::vector<Eigen::Vector3f>& corners) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d origin = corners[0].cast<double>();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vector3d a = corners[i].cast<double>() - origin;
    const Vector3d b = corners[i + 1].cast<double>() - origin;
    sum += Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// The corners along the two axes that the normal is most square to, counter-clockwise.
std::vector<Vector2d> Flattened(const std::vector<Eigen::Vector3f>& corners, const Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index u = (axis + 1) % 3;
  const Eigen::Index v = (axis + 2) % 3;
  const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
  std::vector<Vector2d> flat;
  flat.reserve(corners.size());
  for (const Eigen::Vector3f& p : corners) flat.emplace_back(sign * p[u], p[v]);
  return flat;
}

/// Twice the signed area of the triangle, positive counter-clockwise.
double Turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Left turns all along, and once around.
bool IsConvex(const std::vector<Vector2d>& p) {
  const std::size_t n = p.size();
  int changes = 0;  // of the direction along x: two of them once around, four or more in a star
  double last = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (Turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0.0) return false;
    const double dx = p[(i + 1) % n].x() - p[i].x();
    if (dx == 0.0) continue;
    if (last * dx < 0.0) ++changes;
    last = dx > 0.0 ? 1.0 : -1.0;
  }
  return changes <= 2;
}

Triangles Fan(std::size_t corners) {
  Triangles triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

/// Whether corner `at` of the rest is an ear: it turns left, and no other corner lies in its triangle.
bool IsEar(const std::vector<Vector2d>& p, const std::vector<std::uint32_t>& rest, std::size_t at) {
  const std::size_t n = rest.size();
  const Vector2d& a = p[rest[(at + n - 1) % n]];
  const Vector2d& b = p[rest[at]];
  const Vector2d& c = p[rest[(at + 1) % n]];
  if (Turn(a, b, c) <= 0.0) return false;
  return std::none_of(rest.begin(), rest.end(), [&](std::uint32_t i) {
    const Vector2d& q = p[i];
    if (q == a || q == b || q == c) return false;
    return Turn(a, b, q) >= 0.0 && Turn(b, c, q) >= 0.0 && Turn(c, a, q) >= 0.0;
  });
}

/// Whether the corner lies on the line of its neighbours, so that it can go without any area.
bool IsStraight(const std::vector<Vector2d>& p, const std::vector<std::uint32_t>& rest, std::size_t at) {
  const std::size_t n = rest.size();
  return Turn(p[rest[(at + n - 1) % n]], p[rest[at]], p[rest[(at + 1) % n]]) == 0.0;
}

Triangles CutEars(const std::vector<Vector2d>& p) {
  std::vector<std::uint32_t> rest(p.size());
  std::iota(rest.begin(), rest.end(), 0U);
  Triangles triangles;
  while (rest.size() > 2) {
    std::size_t at = 0;
    while (at < rest.size() && !IsEar(p, rest, at)) ++at;
    if (at == rest.size()) {  // none: take a straight corner away, then look again
      for (at = 0; at < rest.size() && !IsStraight(p, rest, at);) ++at;
      if (at == rest.size()) return {};
    }
    const std::size_t n = rest.size();
    triangles.push_back({rest[(at + n - 1) % n], rest[at], rest[(at + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return triangles;
}

}  // namespace

Triangles Triangulate(const std::vector<Eigen::Vector3f>& corners) {
  if (corners.size() < 3) return {};
  const Vector3d normal = Newell(corners);
  if (corners.size() == 3 || normal.isZero(0.0)) return Fan(corners.size());
  const std::vector<Vector2d> flat = Flattened(corners, normal);
  if (IsConvex(flat)) return Fan(corners.size());
  if (corners.size() > kMostConcaveCorners) return {};
  return CutEars(flat);
}

}  // namespace alula::geometry::internal
