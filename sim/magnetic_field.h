#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::sim {

/// Earth's magnetic field, the same all over the world, by the elements that field models and maps give. Defaults:
/// about those of Zurich, rounded by us (21.4 µT to magnetic north, 43 µT down). Iron in walls and floors is not
/// modelled.
struct MagneticFieldConfig {
  double intensity = 48e-6;                  // T
  double inclination = 1.1082840750163994;   // below the horizon, rad (63.5 deg)
  double declination = 0.05235987755982989;  // of magnetic north from true north, to the east, rad (3 deg)
};
void Describe(base::Description& d, MagneticFieldConfig& c);

/// Flux density in the world's axes (east, north, up), T:
///
///   B_W = F (cos I sin D, cos I cos D, −sin I)
base::Vec3 FluxDensity(const MagneticFieldConfig& config);

}  // namespace alula::sim
