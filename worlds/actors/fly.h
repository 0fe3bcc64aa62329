#pragma once

#include <memory>

#include "worlds/actors/actor.h"
#include "worlds/actors/path_follower.h"

namespace alula::worlds {

struct FlyState {
  std::shared_ptr<const RoundedPath> path;  // null: hovers
  Runner runner;
  double yaw = 0.0;                    // rad, not wrapped
  base::Vec2 tilt = base::Vec2(0, 0);  // pitch, roll; rad
};

/// One tick of another drone: as fast as its path lets it, at rest 2 m before the vehicle where it flies towards it;
/// tilted so that its thrust gives the acceleration that its way asks for, with a lag of 0.15 s.
FlyState Begin(const Fly& fly, base::RandomStream& random);
void Advance(const Fly& fly, FlyState& state, const ActorSurroundings& around);
Neighbour AsNeighbour(const Fly& fly, const FlyState& state);
inline double TopSpeed(const Fly&, const FlyState& state, double) { return state.runner.speed + 0.1; }

/// Place (3), yaw, pitch, roll.
inline std::size_t CoordinateCount(const Fly&) { return 6; }
inline std::size_t JointCount(const Fly&) { return 1; }
void Coordinates(const Fly& fly, const FlyState& state, double* q);
base::Transform PlaceRoot(const Fly& fly, const double* q);
void PlaceJoints(const Fly& fly, const double* q, base::Transform* X_WJ);

}  // namespace alula::worlds
