#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::vehicles {

/// Drag of the airframe without rotors.
struct AerodynamicsConfig {
  base::Vec3 drag_area{0.009, 0.011, 0.022};  // C_d A along body x, y, z, m²
  double linear_drag = 0.02;                  // N·s/m, skin friction at low speed
};
void Describe(base::Description& d, AerodynamicsConfig& c);

/// F_i = −½ ρ (C_d A)_i |v| v_i − c v_i, along body axes; v is the velocity relative to the air (m/s), F in N.
base::Vec3 BodyDrag(const AerodynamicsConfig& c, double air_density, const base::Vec3& v_air_B);

}  // namespace alula::vehicles
