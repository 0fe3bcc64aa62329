#include "worlds/actors/outline.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

template <typename... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

/// Half extents of the box about a solid's own centre.
Vec3 HalfBox(const geometry::Shape& shape) {
  return std::visit(Overloaded{
                        [](const geometry::Box& s) { return s.half_extents; },
                        [](const geometry::Sphere& s) -> Vec3 { return Vec3::Constant(s.radius); },
                        [](const geometry::Cylinder& s) { return Vec3(s.radius, s.radius, s.half_height); },
                        [](const geometry::Capsule& s) { return Vec3(s.radius, s.radius, s.half_height + s.radius); },
                        [](const geometry::Cone& s) { return Vec3(s.radius, s.radius, s.half_height); },
                        [](const geometry::MeshShape&) -> Vec3 { return Vec3::Zero(); },
                    },
                    shape);
}

Outline OfMesh(const geometry::Mesh& mesh, const base::Transform& X_WO) {
  Vec3 low = Vec3::Constant(1e9);
  Vec3 high = Vec3::Constant(-1e9);
  const base::Mat3 R = X_WO.R();
  for (const geometry::Mesh::Vertex& v : mesh.vertices) {
    const Vec3 p = R * v.position.cast<double>() + X_WO.p;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {0.5 * (low + high).head<2>(), {1.0, 0.0}, 0.5 * (high - low).head<2>(), 0.0, low.z(), high.z()};
}

Outline Of(const Object& object) {
  if (const auto* mesh = std::get_if<geometry::MeshShape>(&object.shape)) return OfMesh(*mesh->mesh, object.X_WO);
  const base::Mat3 R = object.X_WO.R();
  const Vec3 half = HalfBox(object.shape);
  const bool upright = R(2, 2) > 1.0 - 1e-9;
  const Vec3 reach = R.cwiseAbs() * half;
  Outline outline{object.X_WO.p.head<2>(),      {1.0, 0.0}, reach.head<2>(), 0.0, object.X_WO.p.z() - reach.z(),
                  object.X_WO.p.z() + reach.z()};
  if (std::holds_alternative<geometry::Box>(object.shape)) {
    if (upright) {
      outline.along = R.col(0).head<2>();
      outline.half = half.head<2>();
    }
  } else if (upright || std::holds_alternative<geometry::Sphere>(object.shape)) {
    outline.half.setZero();
    outline.radius = half.x();
  }
  return outline;
}

}  // namespace

std::vector<Outline> OutlinesOf(const World& world) {
  std::vector<Outline> outlines;
  for (const Object& object : world.objects) {
    const bool is_floor = object.semantic == SemanticClass::kGround || object.semantic == SemanticClass::kPad;
    if (object.collides && !is_floor) outlines.push_back(Of(object));
  }
  return outlines;
}

Gap GapTo(const Outline& outline, const Vec2& p) {
  const Vec2 across(-outline.along.y(), outline.along.x());
  const Vec2 d = p - outline.centre;
  const Vec2 own(outline.along.dot(d), across.dot(d));
  const Vec2 beyond = own.cwiseAbs() - outline.half;
  Vec2 out = Vec2(std::copysign(std::max(beyond.x(), 0.0), own.x()), std::copysign(std::max(beyond.y(), 0.0), own.y()));
  double distance = out.norm();
  if (distance == 0.0) {  // inside: out through the nearest side
    const bool by_x = beyond.x() > beyond.y();
    distance = by_x ? beyond.x() : beyond.y();
    out = by_x ? Vec2(std::copysign(1.0, own.x()), 0.0) : Vec2(0.0, std::copysign(1.0, own.y()));
  } else {
    out /= distance;
  }
  return {out.x() * outline.along + out.y() * across, distance - outline.radius};
}

bool IsClear(const Outline& outline, const Vec2& a, const Vec2& b, double room) {
  // March: a step as long as the distance cannot jump over the outline.
  const double length = (b - a).norm();
  for (double s = 0.0;;) {
    const double free = GapTo(outline, length > 0.0 ? Vec2(a + (b - a) * (s / length)) : a).distance;
    if (free < room) return false;
    if (s >= length) return true;
    s = std::min(length, s + std::max(free - room, 0.02));
  }
}

}  // namespace alula::worlds
