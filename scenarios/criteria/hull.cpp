#include "scenarios/criteria/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace alula::scenarios {
namespace {

// Support functions of solids about their own centre: the largest p·d over the solid.
double Support(const geometry::Box& s, const base::Vec3& d) { return s.half_extents.dot(d.cwiseAbs()); }
double Support(const geometry::Sphere& s, const base::Vec3& d) { return s.radius * d.norm(); }
double Support(const geometry::Cylinder& s, const base::Vec3& d) {
  return s.radius * d.head<2>().norm() + s.half_height * std::abs(d.z());
}
double Support(const geometry::Capsule& s, const base::Vec3& d) {
  return s.radius * d.norm() + s.half_height * std::abs(d.z());
}
double Support(const geometry::Cone& s, const base::Vec3& d) {  // apex up
  return std::max(s.half_height * d.z(), s.radius * d.head<2>().norm() - s.half_height * d.z());
}
double Support(const geometry::MeshShape& s, const base::Vec3& d) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const geometry::Mesh::Vertex& v : s.mesh->vertices) reach = std::max(reach, v.position.cast<double>().dot(d));
  return reach;
}

}  // namespace

double HullReach(const vehicles::VehicleBody& body, const base::Vec3& direction_B) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const vehicles::Part& part : body.parts) {
    if (!part.hull) continue;
    const base::Vec3 direction_P = part.X_BP.q.conjugate() * direction_B;
    const double own = std::visit([&](const auto& shape) { return Support(shape, direction_P); }, part.shape);
    reach = std::max(reach, own + part.X_BP.p.dot(direction_B));
  }
  return reach;
}

}  // namespace alula::scenarios
