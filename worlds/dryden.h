#pragma once

#include <array>

#include "base/random.h"
#include "base/time.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Scale lengths (m) and intensities (m/s) of turbulence near the ground, MIL-F-8785C, 3.7.3 (h in feet, held within
/// 10 and 1000 ft):
///   L_w = h,       L_u = L_v = h / (0.177 + 0.000823 h)^1.2
///   σ_w = 0.1 W₂₀, σ_u = σ_v = σ_w / (0.177 + 0.000823 h)^0.4
struct DrydenScales {
  double length_u = 0.0, length_w = 0.0;
  double sigma_u = 0.0, sigma_w = 0.0;
};
DrydenScales ScalesAt(double height, double w20);

/// Dryden turbulence (MIL-F-8785C, 3.7.1.2): velocities along the mean wind (u), across it (v) and up (w), a frozen
/// field that passes the vehicle at the airspeed V. With τ = L / V and Ω = ω / V the one-sided spectra are
///   Φ_u(Ω) = σ² (2 L / π) / (1 + (L Ω)²)                          H_u(s) ∝ 1 / (1 + τ s)
///   Φ_v(Ω) = σ² (L / π) (1 + 3 (L Ω)²) / (1 + (L Ω)²)²            H_v(s) ∝ (1 + √3 τ s) / (1 + τ s)², also of w.
/// Exact discretisation for any step: u is first-order Gauss–Markov; v = σ (√3 a + (1 − √3) b) with τ a' = −a + noise,
/// τ b' = −b + a, whose transition over U = dt / τ is e^(−U) [1 0; U 1] and whose noise has the covariance
/// ∫₀^U e^(−2u) [1 u; u u²] du, so that v has the variance σ² from the first step on. V is |v − mean wind|, at least
/// Dryden::airspeed_floor: a hovering vehicle in still air would otherwise meet a constant.
class DrydenTurbulence {
 public:
  explicit DrydenTurbulence(base::RandomStream& random);

  /// Advances by dt and gives (u, v, w), m/s, at `height` m above the ground.
  base::Vec3 Advance(const Dryden& dryden, double height, double airspeed, base::Duration dt,
                     base::RandomStream& random);

 private:
  double u_ = 0.0;
  std::array<base::Vec2, 2> chain_;  // (a, b) of v and w, of unit scale
};

}  // namespace alula::worlds
