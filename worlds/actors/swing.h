#pragma once

#include <cmath>
#include <numbers>

#include "worlds/actors/actor.h"
#include "worlds/actors/surroundings.h"

namespace alula::worlds {

struct SwingState {
  double angle = 0.0;  // rad
};

inline double AngleAt(const Swing& swing, base::Time t) {
  return swing.amplitude * std::sin(2.0 * std::numbers::pi * (t.Seconds() / swing.period + swing.phase));
}
inline SwingState Begin(const Swing& swing, base::RandomStream&) { return {AngleAt(swing, {0})}; }
inline void Advance(const Swing& swing, SwingState& state, const ActorSurroundings& around) {
  state.angle = AngleAt(swing, around.now + base::Seconds(around.dt));
}
inline Neighbour AsNeighbour(const Swing&, const SwingState&) { return {}; }
inline double TopSpeed(const Swing& swing, const SwingState&, double reach) {
  return 2.0 * std::numbers::pi / swing.period * swing.amplitude * reach;
}

inline std::size_t CoordinateCount(const Swing&) { return 1; }
inline std::size_t JointCount(const Swing&) { return 1; }
inline void Coordinates(const Swing&, const SwingState& state, double* q) { q[0] = state.angle; }
inline base::Transform PlaceRoot(const Swing& swing, const double* q) {
  return swing.X_WH * base::Transform{base::Exp({q[0], 0.0, 0.0}), base::Vec3::Zero()};
}
inline void PlaceJoints(const Swing& swing, const double* q, base::Transform* X_WJ) { X_WJ[0] = PlaceRoot(swing, q); }

}  // namespace alula::worlds
