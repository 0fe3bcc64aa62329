#include "worlds/actors/fly.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

RunLimits LimitsOf(const Fly& fly) { return {.speed = fly.speed, .accelerate = 2.0, .brake = 2.0, .lateral = 4.0}; }

}  // namespace

FlyState Begin(const Fly& fly, base::RandomStream& random) {
  FlyState state;
  if (fly.waypoints.size() < 2) {
    state.yaw = random.Uniform(-M_PI, M_PI);
    return state;
  }
  state.path = std::make_shared<const RoundedPath>(fly.waypoints, fly.closed, fly.turn_radius, "a drone");
  state.runner.s = fly.start;
  state.runner.speed = SpeedForPath(*state.path, fly.start, LimitsOf(fly));
  state.yaw = state.path->At(fly.start).heading;
  return state;
}

void Advance(const Fly& fly, FlyState& state, const ActorSurroundings& around) {
  if (!state.path) return;
  constexpr double kHoldOff = 2.0;   // m from the vehicle's hull
  constexpr double kTiltLag = 0.15;  // s
  const RunLimits limits = LimitsOf(fly);
  const RoundedPath::Point at = state.path->At(state.runner.s);
  double wanted = SpeedForPath(*state.path, state.runner, limits);
  const Vec3 to_vehicle = around.vehicle.p_WB - at.p;
  const Vec3 way = Vec3(std::cos(at.heading), std::sin(at.heading), at.slope).normalized();
  if (fly.reactive && to_vehicle.dot(way) > 0.3 * to_vehicle.norm()) {
    wanted = std::min(wanted, StoppingSpeed(limits.brake, to_vehicle.norm() - around.vehicle.radius - kHoldOff));
  }
  Run(state.runner, wanted, limits, around.dt);
  if (!state.path->closed()) state.runner.s = std::min(state.runner.s, state.path->length());
  state.yaw += base::WrapAngle(at.heading - state.yaw);
  const double lateral = state.runner.speed * state.runner.speed * at.curvature;
  const Vec2 tilt(std::atan2(state.runner.acceleration, base::kGravity), -std::atan2(lateral, base::kGravity));
  state.tilt += (tilt - state.tilt) * (around.dt / kTiltLag);
}

Neighbour AsNeighbour(const Fly&, const FlyState&) { return {}; }

void Coordinates(const Fly& fly, const FlyState& state, double* q) {
  const Vec3 p = state.path ? state.path->At(state.runner.s).p : fly.waypoints.front();
  std::copy_n(p.data(), 3, q);
  q[3] = state.yaw;
  q[4] = state.tilt.x();
  q[5] = state.tilt.y();
}

base::Transform PlaceRoot(const Fly&, const double* q) {
  return {base::FromYawPitchRoll(q[3], q[4], q[5]), {q[0], q[1], q[2]}};
}

void PlaceJoints(const Fly& fly, const double* q, base::Transform* X_WJ) { X_WJ[0] = PlaceRoot(fly, q); }

}  // namespace alula::worlds
