#pragma once

#include <vector>

#include "worlds/actors/actor.h"
#include "worlds/actors/surroundings.h"

namespace alula::worlds {

/// A tuft's lean, a rotation vector in the horizontal plane, its rate, and how much of the gusts it catches.
struct TuftState {
  base::Vec2 lean{0.0, 0.0};
  base::Vec2 rate{0.0, 0.0};
  double gust = 0.0;
};
struct SwayState {
  std::vector<TuftState> tufts;
};

/// Angle at which a sprung hinge holds an upright stem against wind of speed u: the drag normal to the stem goes with
/// (u cos θ)², so θ = C cos² θ with C in proportion to the Cauchy number u² (de Langre 2008, Annu. Rev. Fluid Mech. 40,
/// 141), here C = ½ / cos² ½ · (u / stiffness_speed)².
double RestingLean(double speed, double stiffness_speed);

/// One tick of grass: the air about a tuft is half of the wind (log law over z₀ = 3 cm, from 2 m down to 0.25 m), 30 %
/// up and down with gusts of its own, and the ground jet of the vehicle's downwash (grass.h). A tuft swings about its
/// resting lean as a damped oscillator, in steps that keep a spring of 2.5 Hz stable.
SwayState Begin(const Sway& sway, base::RandomStream& random);
void Advance(const Sway& sway, SwayState& state, const ActorSurroundings& around);
inline Neighbour AsNeighbour(const Sway&, const SwayState&) { return {}; }
inline double TopSpeed(const Sway&, const SwayState&, double) { return 0.3; }

inline std::size_t CoordinateCount(const Sway& sway) { return 2 * sway.X_WR.size(); }
inline std::size_t JointCount(const Sway& sway) { return sway.X_WR.size(); }
void Coordinates(const Sway& sway, const SwayState& state, double* q);
base::Transform PlaceRoot(const Sway& sway, const double* q);
void PlaceJoints(const Sway& sway, const double* q, base::Transform* X_WJ);

}  // namespace alula::worlds
