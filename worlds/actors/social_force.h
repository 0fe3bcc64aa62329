#pragma once

#include "base/frames.h"
#include "worlds/actors/outline.h"

namespace alula::worlds {

// Accelerations of the social force model of Helbing & Molnár 1995 ("Social force model for pedestrian dynamics",
// Phys. Rev. E 51, 4282); m/s², horizontal plane.

/// Towards the wished velocity: (v_wish − v) / τ, τ = 0.5 s (eq. 2).
base::Vec2 DrivingForce(const base::Vec2& v_wish, const base::Vec2& v);

/// From another moving body: −∇V(b), V = V₀ exp(−b / σ), with the semi-minor axis of the ellipse that the other's next
/// two seconds span, 2b = √((|r| + |r − v Δt|)² − |v Δt|²) (eqs. 3–4); r points from it to us, v is its velocity.
/// What lies behind, out of the 200° of view about `facing` (unit), counts half (eqs. 7 and 8). People: V₀ = 2.1 m²/s²,
/// σ = 0.3 m.
struct Repulsion {
  double strength = 2.1;  // V₀, m²/s²
  double range = 0.3;     // σ, m
};
base::Vec2 BodyForce(const Repulsion& repulsion, const base::Vec2& r, const base::Vec2& v_other,
                     const base::Vec2& facing);

/// From a thing that stands: (U₀ / R) exp(−d / R) away from it (eq. 5), U₀ = 5 m²/s², R = 0.1 m. The paper's 10 m²/s²
/// and 0.2 m are of wide walkways: with them nobody enters a doorway of 0.7 m.
base::Vec2 BorderForce(const Gap& gap);

}  // namespace alula::worlds
