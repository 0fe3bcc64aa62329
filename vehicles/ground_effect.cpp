#include "vehicles/ground_effect.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

void Describe(base::Description& d, GroundEffectConfig& c) {
  d.Field("body_lift", c.body_lift, {.meaning = "K_b of the fountain below the body", .min = 0, .max = 4});
}

double GroundEffectRatio(const GroundEffectConfig& config, const RotorSpacing& spacing, double z, double speed_ratio) {
  if (!std::isfinite(z)) return 1.0;
  const double R = spacing.radius, height = std::max(z, 0.5 * R);
  // A source at the distance √(square + 4z²) of its image.
  const auto image = [R, height](double square) {
    return R * R * height / std::pow(square + 4.0 * height * height, 1.5);
  };
  const double adjacent = spacing.adjacent * spacing.adjacent, opposite = spacing.opposite * spacing.opposite;
  const double own = R / (4.0 * height);
  const double blocked =
      own * own + image(adjacent) + 0.5 * image(2.0 * adjacent) + 2.0 * config.body_lift * image(opposite);
  return 1.0 / (1.0 - std::min(0.5, blocked / (1.0 + speed_ratio * speed_ratio)));
}

}  // namespace alula::vehicles
