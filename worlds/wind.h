#pragma once

#include <cstdint>
#include <optional>

#include "base/random.h"
#include "base/time.h"
#include "worlds/dryden.h"
#include "worlds/shelter.h"
#include "worlds/world.h"

namespace alula::worlds {

/// What a 1-cosine gust adds at t seconds: velocity · ½ (1 − cos(2π (t − start) / duration)) while it lasts (FAR
/// 25.341, in time).
base::Vec3 GustAt(const CosineGust& gust, double t);

/// The moving air: (mean + gusts) · shelter.
///
/// Gusts: one first-order Gauss–Markov process a world axis, g' = −g/τ + σ·√(2/τ)·w, in its exact discretisation
/// g(t+dt) = a·g(t) + σ·√(1−a²)·n with a = e^(−dt/τ); it starts in its stationary distribution, so the standard
/// deviation is σ from the first step on and whatever the step. Stream "wind" of the seed. Then Dryden turbulence
/// (dryden.h; stream "wind/dryden"; u along the mean wind, or east where there is none) and single 1-cosine gusts.
/// All is uniform in space, a courtyard being small against the length of gusts, but for the shelter (shelter.h) at the
/// place where it is asked for, which is looked up every 10 ms.
class WindField {
 public:
  /// Without shelter. Throws base::InputError for a gust or turbulence that cannot be.
  WindField(const Wind& wind, std::uint64_t seed);
  /// With that of the world's objects, where its wind asks for it.
  WindField(const World& world, std::uint64_t seed);

  /// Advances by dt ≥ 0 and gives the velocity of the air at p_W for one who moves with v_W, m/s, world axes.
  base::Vec3 At(const base::Vec3& p_W, base::Duration dt, const base::Vec3& v_W = base::Vec3::Zero());

 private:
  base::Vec3 Turbulence(const base::Vec3& p_W, base::Duration dt, const base::Vec3& v_W);

  Wind wind_;
  base::RandomStream random_;
  base::Vec3 gust_W_;
  base::Duration step_{-1};  // for which decay_ and drive_ hold
  double decay_ = 1.0;
  double drive_ = 0.0;
  base::Time time_;
  base::RandomStream dryden_random_;
  std::optional<DrydenTurbulence> dryden_;
  std::optional<Shelter> shelter_;
  double through_ = 1.0;
  base::Time looked_up_{-1'000'000'000};
};

}  // namespace alula::worlds
