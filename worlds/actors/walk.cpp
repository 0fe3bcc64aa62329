#include "worlds/actors/walk.h"

#include <algorithm>
#include <cmath>

#include "worlds/actors/social_force.h"
#include "worlds/kit/terrain.h"

namespace alula::worlds {
namespace {

using base::Vec2;
using base::Vec3;

constexpr double kArrived = 0.45;     // m from a waypoint: the next one is wanted
constexpr double kBodyRadius = 0.25;  // m
constexpr double kHardRoom = 0.22;    // m from the middle to what stands: never less

GroundHeight GroundOf(const Walk& walk, const WalkState& state) {
  if (walk.ground) return [field = walk.ground.get()](const Vec2& p) { return HeightAt(*field, p); };
  return [z = state.z](const Vec2&) { return z; };
}

/// Where the walker wants to be next on the line that it follows, and how far it is to its end.
struct Goal {
  Vec2 towards{0.0, 0.0};  // unit, or 0 where it has arrived
  double distance = 0.0;
};

std::size_t Previous(const Walk& walk, const WalkState& state) {
  const std::size_t n = walk.route.size();
  if (walk.closed) return (state.next + n - 1) % n;
  return state.back ? std::min(state.next + 1, n - 1) : (state.next == 0 ? 0 : state.next - 1);
}

Goal GoalOf(const Walk& walk, const WalkState& state) {
  constexpr double kLookAhead = 1.2;  // m along the line
  const Vec2 end = walk.route[state.next].head<2>();
  const Vec2 begin = walk.route[Previous(walk, state)].head<2>();
  const Vec2 line = end - begin;
  const double length = line.norm();
  const Vec2 p = state.body.p;
  Vec2 aim = end;
  if (length > 1e-6) {
    const double s = std::clamp((p - begin).dot(line) / length + kLookAhead, 0.0, length);
    aim = begin + line * (s / length);
  }
  const Vec2 way = aim - p;
  return {way.norm() > 1e-6 ? Vec2(way.normalized()) : Vec2::Zero(), (end - p).norm()};
}

void ChooseNext(const Walk& walk, WalkState& state) {
  const std::size_t n = walk.route.size();
  if (n < 2) return;
  if (walk.closed) {
    state.next = (state.next + 1) % n;
  } else if (!state.back && state.next + 1 == n) {
    state.back = true;
    state.next = n - 2;
  } else if (state.back && state.next == 0) {
    state.back = false;
    state.next = 1;
  } else {
    state.next = state.back ? state.next - 1 : state.next + 1;
  }
}

/// Share of the wished speed that a vehicle in the way leaves.
double SpeedBefore(const Walk& walk, const Vec2& towards, const Vec2& p, const ActorSurroundings& around) {
  constexpr double kStand = 0.8;  // m from its hull
  constexpr double kHeed = 2.5;   // m
  const Vec2 to_vehicle = around.vehicle.p_WB.head<2>() - p;
  const double distance = to_vehicle.norm();
  if (!walk.reactive || distance < 1e-6 || to_vehicle.dot(towards) < 0.3 * distance) return 1.0;
  return std::clamp((distance - around.vehicle.radius - kStand) / (kHeed - kStand), 0.0, 1.0);
}

bool HeedsVehicle(const Walk& walk, const WalkState& state, const ActorSurroundings& around) {
  const double above = around.vehicle.p_WB.z() - state.gait.feet[0].ball.z();
  return walk.reactive && above < walk.height + 1.0 && above > -1.0;
}

/// Whether an outline at the walker's height may lie within `reach` m.
bool IsBeside(const Walk& walk, const WalkState& state, const Outline& outline, double reach) {
  constexpr double kStepOver = 0.1;  // m
  const double near = outline.half.norm() + outline.radius + reach;
  return outline.high > state.z + kStepOver && outline.low < state.z + walk.height &&
         (state.body.p - outline.centre).squaredNorm() < near * near;
}

Vec2 Forces(const Walk& walk, const WalkState& state, const ActorSurroundings& around) {
  constexpr double kHeeded = 3.0;  // m
  const Body& body = state.body;
  const Vec2 facing(std::cos(body.yaw), std::sin(body.yaw));
  Vec2 force = Vec2::Zero();
  for (std::size_t i = 0; i < around.others.size(); ++i) {
    const Neighbour& other = around.others[i];
    if (i == around.self || !IsBeside(walk, state, other.outline, kHeeded + 2.0 * other.v.norm())) continue;
    if (!other.is_solid) continue;
    const Gap gap = GapTo(other.outline, body.p);
    force += BodyForce({}, (gap.distance + kBodyRadius) * gap.away, other.v, facing);
  }
  for (const Outline& outline : around.outlines) {
    if (!IsBeside(walk, state, outline, 1.0)) continue;
    const Gap gap = GapTo(outline, body.p);
    if (gap.distance < 1.0) force += BorderForce(gap);
  }
  if (HeedsVehicle(walk, state, around)) {
    const Vec2 r = body.p - around.vehicle.p_WB.head<2>();
    const double distance = std::max(r.norm(), 1e-3);
    const Vec2 from_hull = r * std::max(distance - around.vehicle.radius, 0.05) / distance;
    force += BodyForce({.strength = 6.0, .range = 0.6}, from_hull, around.vehicle.v_WB.head<2>(), facing);
  }
  return force;
}

/// Nobody walks through what stands, however they are pushed.
void KeepOut(const Walk& walk, WalkState& state, const Outline& outline) {
  if (!IsBeside(walk, state, outline, kHardRoom)) return;
  const Gap gap = GapTo(outline, state.body.p);
  if (gap.distance >= kHardRoom) return;
  state.body.p += (kHardRoom - gap.distance) * gap.away;
  state.body.v -= std::min(state.body.v.dot(gap.away), 0.0) * gap.away;
}

void Turn(Body& body, double dt) {
  constexpr double kGain = 5.0;     // 1/s
  constexpr double kFastest = 2.5;  // rad/s
  constexpr double kWalks = 0.25;   // m/s: who moves less keeps facing where they do
  body.yaw_rate = 0.0;
  if (body.v.norm() < kWalks) return;
  const double off = base::WrapAngle(std::atan2(body.v.y(), body.v.x()) - body.yaw);
  body.yaw_rate = std::clamp(kGain * off, -kFastest, kFastest);
  body.yaw += body.yaw_rate * dt;  // not wrapped: coordinates are interpolated
}

}  // namespace

WalkState Begin(const Walk& walk, base::RandomStream& random) {
  WalkState state;
  const std::size_t n = walk.route.size();
  state.next = n > 1 ? 1 : 0;
  double rest = walk.start;
  Vec3 p = walk.route[0];
  Vec2 heading(1.0, 0.0);
  const std::size_t lines = walk.closed ? n : n - 1;
  for (std::size_t i = 0; i < lines && n > 1; ++i) {
    const Vec3 line = walk.route[(i + 1) % n] - walk.route[i];
    const double length = line.norm();
    state.next = (i + 1) % n;
    if (length > 1e-6) heading = line.head<2>().normalized();
    p = walk.route[i] + line * std::min(rest / std::max(length, 1e-6), 1.0);
    if (rest <= length) break;
    rest -= length;
  }
  state.z = p.z();
  state.body.p = p.head<2>();
  state.body.yaw = n > 1 ? std::atan2(heading.y(), heading.x()) : random.Uniform(-M_PI, M_PI);
  if (n > 1) state.body.v = walk.speed * heading;
  state.gait = StandAt(state.body, walk.height, n > 1 ? random.Uniform() : 0.05, GroundOf(walk, state));
  return state;
}

void Advance(const Walk& walk, WalkState& state, const ActorSurroundings& around) {
  constexpr double kJitter = 0.1;  // m/s per root second: nobody stays in a tie
  constexpr double kHurry = 1.3;   // of the wished speed, at most
  const bool stands = walk.route.size() < 2;
  Body& body = state.body;
  Goal goal = GoalOf(walk, state);
  if (!stands && goal.distance < kArrived) {
    ChooseNext(walk, state);
    goal = GoalOf(walk, state);
  }
  const double wished = stands ? (goal.distance > 0.3 ? std::min(goal.distance, 0.6) : 0.0) : walk.speed;
  const bool heeds = HeedsVehicle(walk, state, around);
  const double share = heeds ? SpeedBefore(walk, goal.towards, body.p, around) : 1.0;
  const Vec2 jitter = kJitter / std::sqrt(around.dt) * Vec2(around.random.Gaussian(), around.random.Gaussian());
  Vec2 force = Forces(walk, state, around);
  if (stands && force.norm() < 0.5) force.setZero();  // who stands does not shuffle for a breath
  const Vec2 push = stands || share == 0.0 ? Vec2::Zero() : jitter;
  body.v += around.dt * (DrivingForce(share * wished * goal.towards, body.v) + force + push);
  const double fastest = kHurry * std::max(walk.speed, 0.6);
  if (body.v.norm() > fastest) body.v *= fastest / body.v.norm();
  body.p += around.dt * body.v;
  for (std::size_t i = 0; i < around.others.size(); ++i) {
    if (i != around.self && around.others[i].is_solid) KeepOut(walk, state, around.others[i].outline);
  }
  for (const Outline& outline : around.outlines) KeepOut(walk, state, outline);
  Turn(body, around.dt);

  const Vec3& end = walk.route[state.next];
  const Vec3& begin = walk.route[Previous(walk, state)];
  const double line = (end - begin).head<2>().norm();
  const double left = line > 1e-6 ? std::clamp((end.head<2>() - body.p).norm() / line, 0.0, 1.0) : 0.0;
  state.z = end.z() + left * (begin.z() - end.z());
  if (walk.ground) state.z = HeightAt(*walk.ground, body.p);
  StepGait(state.gait, body, walk.height, around.dt, GroundOf(walk, state));
}

Neighbour AsNeighbour(const Walk& walk, const WalkState& state) {
  const Outline outline{state.body.p, {1.0, 0.0}, {0.0, 0.0}, kBodyRadius, state.z, state.z + walk.height};
  return {outline, state.body.v, true};
}

}  // namespace alula::worlds
