#pragma once

#include <memory>

#include "worlds/actors/actor.h"
#include "worlds/actors/path_follower.h"

namespace alula::worlds {

struct DriveState {
  std::shared_ptr<const RoundedPath> path;  // null: parked
  Runner runner;
  double yaw = 0.0;     // rad, not wrapped
  double steer = 0.0;   // rad, of the front wheels: atan(wheelbase · curvature)
  double rolled = 0.0;  // m that the wheels have rolled
};

/// One tick of a car: as fast as it may and as its path lets it (2 m/s² in bends), stopping 1.5 m before what stands or
/// walks within its half width + 0.3 m of the path ahead. Throws base::InputError as RoundedPath does.
DriveState Begin(const Drive& drive, base::RandomStream& random);
void Advance(const Drive& drive, DriveState& state, const ActorSurroundings& around);
Neighbour AsNeighbour(const Drive& drive, const DriveState& state);
inline double TopSpeed(const Drive&, const DriveState& state, double) { return 2.0 * state.runner.speed; }

/// Place of the rear axle's middle on the ground (3), yaw, pitch, roll, steering angle, angle of the wheels.
inline std::size_t CoordinateCount(const Drive&) { return 8; }
inline std::size_t JointCount(const Drive&) { return 5; }
void Coordinates(const Drive& drive, const DriveState& state, double* q);
base::Transform PlaceRoot(const Drive& drive, const double* q);
void PlaceJoints(const Drive& drive, const double* q, base::Transform* X_WJ);

/// From the middle of the rear axle: how far the body reaches forward and back, m.
inline double FrontReach(const Drive& drive) { return drive.wheelbase + 0.8; }
inline double RearReach(const Drive&) { return 0.8; }

}  // namespace alula::worlds
