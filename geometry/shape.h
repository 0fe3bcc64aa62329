#pragma once

#include <memory>
#include <variant>

#include "base/frames.h"
#include "geometry/mesh.h"

namespace alula::geometry {

// Solids about their own centre; cylinders, capsules and cones stand along z.
struct Box {
  base::Vec3 half_extents = base::Vec3::Constant(0.5);  // m
};
struct Sphere {
  double radius = 0.5;
};
struct Cylinder {
  double radius = 0.5;
  double half_height = 0.5;
};
struct Capsule {
  double radius = 0.5;
  double half_height = 0.5;  // of the straight part
};
struct Cone {
  double radius = 0.5;
  double half_height = 0.5;
};
/// A static triangle mesh; shared, never changed.
struct MeshShape {
  std::shared_ptr<const Mesh> mesh;
};

/// The one description from which both Bullet and the renderer are built.
using Shape = std::variant<Box, Sphere, Cylinder, Capsule, Cone, MeshShape>;

/// Triangles of a shape in its own frame, for the renderer. `texture_scale`: metres that one texture period covers.
/// `segments`: of a full circle. Box faces get planar coordinates, round ones unrolled coordinates.
Mesh Tessellate(const Shape& shape, double texture_scale = 1.0, int segments = 24);

/// Mass properties of a solid of uniform density: volume (m³) and, for unit mass, the inertia tensor about the centre
/// of mass in the shape's axes (m²), and the centre of mass.
struct SolidProperties {
  double volume = 0.0;
  base::Vec3 centre = base::Vec3::Zero();
  base::Mat3 unit_inertia = base::Mat3::Zero();
};
SolidProperties Properties(const Shape& shape);

/// Inertia of `mass` (kg) placed by X_BS, about the origin of B, in B's axes, kg·m² (parallel-axis theorem).
base::Mat3 InertiaAbout(const SolidProperties& solid, double mass, const base::Transform& X_BS);

}  // namespace alula::geometry
