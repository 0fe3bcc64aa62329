#pragma once

#include "worlds/actors/actor.h"
#include "worlds/actors/gait.h"
#include "worlds/actors/surroundings.h"

namespace alula::worlds {

struct WalkState {
  Body body;
  double z = 0.0;  // of the route here, m
  GaitState gait;
  std::size_t next = 0;  // waypoint
  bool back = false;     // on the way back
};

/// One tick of a person: heads for the next waypoint, heeds people, walls and the vehicle, walks. Near the vehicle a
/// reactive person steps aside (a repulsion three times as strong as from people and 0.6 m far) and slows down where it
/// is before them, to stand 0.8 m from its hull; what flies a metre over their head is not heeded.
WalkState Begin(const Walk& walk, base::RandomStream& random);
void Advance(const Walk& walk, WalkState& state, const ActorSurroundings& around);
Neighbour AsNeighbour(const Walk& walk, const WalkState& state);

/// Of its fastest part, m/s.
inline double TopSpeed(const Walk&, const WalkState& state, double) { return 3.0 * state.body.v.norm(); }

inline std::size_t CoordinateCount(const Walk&) { return kWalkCoordinates; }
inline std::size_t JointCount(const Walk&) { return kPersonJoints; }
inline void Coordinates(const Walk& walk, const WalkState& state, double* q) {
  WalkCoordinates(state.gait, state.body, walk.height, q);
}
inline base::Transform PlaceRoot(const Walk&, const double* q) { return PelvisPose(q); }
inline void PlaceJoints(const Walk& walk, const double* q, base::Transform* X_WJ) { PlacePerson(walk.height, q, X_WJ); }

}  // namespace alula::worlds
