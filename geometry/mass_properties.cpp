#include <numbers>

#include "base/error.h"
#include "geometry/shape.h"

namespace alula::geometry {
namespace {

using base::Mat3;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

Mat3 Diagonal(double xx, double yy, double zz) { return Vec3(xx, yy, zz).asDiagonal(); }

SolidProperties Of(const Box& box) {
  const Vec3 s = box.half_extents.cwiseAbs2() / 3.0;
  return {8.0 * box.half_extents.prod(), Vec3::Zero(), Diagonal(s.y() + s.z(), s.x() + s.z(), s.x() + s.y())};
}

SolidProperties Of(const Sphere& sphere) {
  const double r2 = sphere.radius * sphere.radius;
  return {4.0 / 3.0 * kPi * r2 * sphere.radius, Vec3::Zero(), 0.4 * r2 * Mat3::Identity()};
}

SolidProperties Of(const Cylinder& c) {
  const double r2 = c.radius * c.radius;
  const double across = r2 / 4.0 + c.half_height * c.half_height / 3.0;
  return {2.0 * kPi * r2 * c.half_height, Vec3::Zero(), Diagonal(across, across, r2 / 2.0)};
}

/// A cylinder and two half spheres; a half sphere's centre of mass is 3/8 r from its flat side.
SolidProperties Of(const Capsule& c) {
  const double r = c.radius;
  const double h = c.half_height;
  const double straight = 2.0 * kPi * r * r * h;
  const double round = 4.0 / 3.0 * kPi * r * r * r;
  const double m = straight / (straight + round);  // mass shares
  const double n = 1.0 - m;
  const double across = m * (r * r / 4.0 + h * h / 3.0) + n * (0.4 * r * r + h * h + 0.75 * r * h);
  return {straight + round, Vec3::Zero(), Diagonal(across, across, m * r * r / 2.0 + n * 0.4 * r * r)};
}

SolidProperties Of(const Cone& c) {
  const double r2 = c.radius * c.radius;
  const double across = 0.15 * (r2 + c.half_height * c.half_height);
  return {2.0 / 3.0 * kPi * r2 * c.half_height, Vec3(0.0, 0.0, -0.5 * c.half_height),
          Diagonal(across, across, 0.3 * r2)};
}

/// Sums signed tetrahedra from the origin to each triangle (a, b, c): volume det/6, first moment det/24·(a+b+c),
/// second moment det/120·(aaᵀ + bbᵀ + ccᵀ + ssᵀ) with s = a + b + c.
SolidProperties Of(const MeshShape& shape) {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const auto& t : shape.mesh->triangles) {
    const Vec3 a = shape.mesh->vertices[t[0]].position.cast<double>();
    const Vec3 b = shape.mesh->vertices[t[1]].position.cast<double>();
    const Vec3 c = shape.mesh->vertices[t[2]].position.cast<double>();
    const double det = a.dot(b.cross(c));
    const Vec3 s = a + b + c;
    volume += det / 6.0;
    first += det / 24.0 * s;
    second += det / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  if (!(volume > 0.0)) {
    throw base::InputError(
        "a mesh of volume " + std::to_string(volume) +
        " m³ is no solid; its surface must be closed and its triangles counter-clockwise from outside");
  }
  const Vec3 centre = first / volume;
  const Mat3 covariance = second / volume - centre * centre.transpose();
  return {volume, centre, covariance.trace() * Mat3::Identity() - covariance};
}

}  // namespace

SolidProperties Properties(const Shape& shape) {
  return std::visit([](const auto& solid) { return Of(solid); }, shape);
}

base::Mat3 InertiaAbout(const SolidProperties& solid, double mass, const base::Transform& X_BS) {
  const Mat3 R_BS = X_BS.R();
  const Vec3 d = X_BS * solid.centre;
  return mass * (R_BS * solid.unit_inertia * R_BS.transpose() + d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

}  // namespace alula::geometry
