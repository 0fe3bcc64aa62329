#include "vehicles/vortex_ring.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

void Describe(base::Description& d, VortexRingConfig& c) {
  d.Field("begin", c.begin, {.meaning = "descent rate over hover's induced velocity where it begins", .min = 0});
  d.Field("worst", c.worst, {.meaning = "where it is worst", .min = 0.1});
  d.Field("end", c.end, {.meaning = "where it ends", .min = 0.1, .max = 4});
  d.Field("swept", c.swept,
          {.meaning = "horizontal air speed over hover's induced velocity that washes it away", .min = 0.1});
  d.Field("thrust_loss", c.thrust_loss, {.meaning = "share of hover thrust lost at the worst", .min = 0, .max = 0.9});
  d.Field("fluctuation", c.fluctuation,
          {.meaning = "standard deviation, share of hover thrust at the worst", .min = 0, .max = 0.5});
  d.Field("time_constant", c.time_constant, {.unit = "s", .meaning = "of the fluctuation", .min = 1e-3, .max = 10});
  d.Check("worst",
          [&c] { return c.begin < c.worst && c.worst < c.end ? "" : "the ring is worst between `begin` and `end`"; });
}

double VortexRingStrength(const VortexRingConfig& config, double descent, double horizontal) {
  if (descent <= config.begin || descent >= config.end) return 0.0;
  const double width = descent < config.worst ? config.worst - config.begin : config.end - config.worst;
  const double formed = 0.5 * (1.0 + std::cos(M_PI * (descent - config.worst) / width));
  const double washed = horizontal / config.swept;
  return formed * std::max(0.0, 1.0 - washed * washed);
}

}  // namespace alula::vehicles
