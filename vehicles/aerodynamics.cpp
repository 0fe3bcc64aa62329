#include "vehicles/aerodynamics.h"

namespace alula::vehicles {

void Describe(base::Description& d, AerodynamicsConfig& c) {
  d.Field("drag_area", c.drag_area, {.unit = "m^2", .meaning = "C_d A along body x, y and z", .min = 0, .max = 10});
  d.Field("linear_drag", c.linear_drag,
          {.unit = "N*s/m", .meaning = "drag proportional to air speed", .min = 0, .max = 10});
}

base::Vec3 BodyDrag(const AerodynamicsConfig& c, double air_density, const base::Vec3& v_air_B) {
  return -(0.5 * air_density * v_air_B.norm() * c.drag_area.array() + c.linear_drag).matrix().cwiseProduct(v_air_B);
}

}  // namespace alula::vehicles
