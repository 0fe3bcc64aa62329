#include "sim/magnetic_field.h"

#include <cmath>
#include <numbers>

namespace alula::sim {

void Describe(base::Description& d, MagneticFieldConfig& c) {
  constexpr double kPi = std::numbers::pi;
  d.Field("intensity", c.intensity, {.unit = "T", .meaning = "of Earth's field", .min = 0, .max = 1e-3});
  d.Field("inclination", c.inclination,
          {.unit = "rad", .meaning = "below the horizon; negative in the south", .min = -0.5 * kPi, .max = 0.5 * kPi});
  d.Field("declination", c.declination,
          {.unit = "rad", .meaning = "of magnetic north from true north, to the east", .min = -kPi, .max = kPi});
}

base::Vec3 FluxDensity(const MagneticFieldConfig& c) {
  return c.intensity * base::Vec3(std::cos(c.inclination) * std::sin(c.declination),
                                  std::cos(c.inclination) * std::cos(c.declination), -std::sin(c.inclination));
}

}  // namespace alula::sim
