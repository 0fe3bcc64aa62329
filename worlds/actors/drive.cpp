#include "worlds/actors/drive.h"

#include <algorithm>
#include <cmath>

#include "worlds/kit/terrain.h"

namespace alula::worlds {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

RunLimits LimitsOf(const Drive& drive) {
  return {.speed = drive.speed, .accelerate = 1.8, .brake = 3.0, .lateral = 2.0};
}

RoundedPath::Point Place(const Drive& drive, const DriveState& state) {
  if (state.path) return state.path->At(state.runner.s);
  return {.p = drive.waypoints.front(), .heading = drive.heading};
}

/// Room between the front and what is in the way, m.
double FreeAhead(const Drive& drive, const DriveState& state, const ActorSurroundings& around, double reach) {
  constexpr double kStep = 0.4;    // m along the path
  constexpr double kBeside = 0.3;  // m
  constexpr double kStand = 1.5;   // m
  const Vec3 p = state.path->At(state.runner.s).p;
  const double farthest = FrontReach(drive) + kStand + reach;
  std::vector<Outline> near;
  const auto consider = [&](const Outline& outline) {
    if ((outline.centre - p.head<2>()).norm() > farthest + outline.radius + outline.half.norm()) return;
    if (outline.low < p.z() + 2.0 && outline.high > p.z() - 0.5) near.push_back(outline);
  };
  for (std::size_t i = 0; i < around.others.size(); ++i) {
    if (i != around.self && around.others[i].is_solid) consider(around.others[i].outline);
  }
  const Vec3& vehicle = around.vehicle.p_WB;
  const double size = around.vehicle.radius;
  if (drive.reactive) consider({vehicle.head<2>(), {1, 0}, {0, 0}, size, vehicle.z() - size, vehicle.z() + size});
  if (near.empty()) return reach;
  for (double ahead = FrontReach(drive); ahead < farthest; ahead += kStep) {
    if (!state.path->closed() && state.runner.s + ahead > state.path->length() + kStand) break;
    const Vec2 at = state.path->At(state.runner.s + ahead).p.head<2>();
    for (const Outline& outline : near) {
      if (GapTo(outline, at).distance < drive.half_width + kBeside) return ahead - FrontReach(drive) - kStand;
    }
  }
  return reach;
}

}  // namespace

DriveState Begin(const Drive& drive, base::RandomStream&) {
  DriveState state;
  state.yaw = drive.heading;
  if (drive.waypoints.size() < 2) return state;
  state.path = std::make_shared<const RoundedPath>(drive.waypoints, drive.closed, drive.turn_radius, "a car");
  state.runner.s = drive.start;
  const RoundedPath::Point at = state.path->At(drive.start);
  state.yaw = at.heading;
  state.steer = std::atan(drive.wheelbase * at.curvature);
  state.runner.speed = SpeedForPath(*state.path, drive.start, LimitsOf(drive));
  return state;
}

void Advance(const Drive& drive, DriveState& state, const ActorSurroundings& around) {
  if (!state.path) return;
  const RunLimits limits = LimitsOf(drive);
  const double reach = limits.speed * limits.speed / (2.0 * limits.brake) + 3.0;
  const double free = FreeAhead(drive, state, around, reach);
  const double wanted =
      std::min(SpeedForPath(*state.path, state.runner, limits), free < reach ? StoppingSpeed(limits.brake, free) : 1e9);
  const double before = state.runner.s;
  Run(state.runner, wanted, limits, around.dt);
  if (!state.path->closed()) state.runner.s = std::min(state.runner.s, state.path->length());
  state.rolled += state.runner.s - before;
  const RoundedPath::Point at = state.path->At(state.runner.s);
  state.yaw += base::WrapAngle(at.heading - state.yaw);
  constexpr double kSteerRate = 1.2;  // rad/s: a path's curvature steps, a wheel does not
  const double steer = std::atan(drive.wheelbase * at.curvature);
  state.steer += std::clamp(steer - state.steer, -kSteerRate * around.dt, kSteerRate * around.dt);
}

Neighbour AsNeighbour(const Drive& drive, const DriveState& state) {
  const Vec3 p = Place(drive, state).p;
  const Vec2 forward(std::cos(state.yaw), std::sin(state.yaw));
  const double half = 0.5 * (FrontReach(drive) + RearReach(drive));
  const Outline outline{
      p.head<2>() + (FrontReach(drive) - half) * forward, forward, {half, drive.half_width}, 0.0, p.z(), p.z() + 1.5};
  return {outline, state.runner.speed * forward, true};
}

void Coordinates(const Drive& drive, const DriveState& state, double* q) {
  const RoundedPath::Point at = Place(drive, state);
  Vec3 p = at.p;
  double pitch = -std::atan(at.slope);
  double roll = 0.0;
  if (drive.ground) {  // the plane through the rear wheels and the middle of the front ones
    const Vec2 forward(std::cos(state.yaw), std::sin(state.yaw));
    const Vec2 left = 0.5 * drive.track * Vec2(-forward.y(), forward.x());
    const double z_left = HeightAt(*drive.ground, p.head<2>() + left);
    const double z_right = HeightAt(*drive.ground, p.head<2>() - left);
    p.z() = 0.5 * (z_left + z_right);
    const double z_front = HeightAt(*drive.ground, p.head<2>() + drive.wheelbase * forward);
    pitch = -std::atan2(z_front - p.z(), drive.wheelbase);
    roll = std::atan2(z_left - z_right, drive.track);
  }
  std::copy_n(p.data(), 3, q);
  q[3] = state.yaw;
  q[4] = pitch;
  q[5] = roll;
  q[6] = state.steer;
  q[7] = state.rolled / drive.wheel_radius;
}

Transform PlaceRoot(const Drive&, const double* q) {
  return {base::FromYawPitchRoll(q[3], q[4], q[5]), {q[0], q[1], q[2]}};
}

void PlaceJoints(const Drive& drive, const double* q, Transform* X_WJ) {
  X_WJ[0] = PlaceRoot(drive, q);
  for (int i = 0; i < 4; ++i) {
    const bool front = i < 2;
    const Vec3 axle(front ? drive.wheelbase : 0.0, i % 2 == 0 ? 0.5 * drive.track : -0.5 * drive.track,
                    drive.wheel_radius);
    X_WJ[1 + i] = X_WJ[0] * Transform{base::FromYawPitchRoll(front ? q[6] : 0.0, q[7], 0.0), axle};
  }
}

}  // namespace alula::worlds
