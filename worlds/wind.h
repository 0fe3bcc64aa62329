#pragma once

#include <cstdint>

#include "base/random.h"
#include "base/time.h"
#include "worlds/world.h"

namespace alula::worlds {

/// The moving air: mean plus one first-order Gauss–Markov process a world axis, g' = −g/τ + σ·√(2/τ)·w, in its exact
/// discretisation g(t+dt) = a·g(t) + σ·√(1−a²)·n with a = e^(−dt/τ). It starts in its stationary distribution, so the
/// standard deviation is σ from the first step on and whatever the step. Stream "wind" of the seed.
class WindField {
 public:
  WindField(const Wind& wind, std::uint64_t seed);

  /// Advances the gusts by dt ≥ 0 and gives the velocity of the air at p_W, m/s, world axes. Gusts are uniform in
  /// space: a courtyard is small against their length.
  base::Vec3 At(const base::Vec3& p_W, base::Duration dt);

 private:
  Wind wind_;
  base::RandomStream random_;
  base::Vec3 gust_W_;
  base::Duration step_{-1};  // for which decay_ and drive_ hold
  double decay_ = 1.0;
  double drive_ = 0.0;
};

}  // namespace alula::worlds
