#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/frames.h"
#include "geometry/shape.h"
#include "worlds/semantic_class.h"

namespace alula::worlds {

struct HeightField;

/// One solid of an actor, fixed to one of the joint frames J that its motion moves.
struct ActorLink {
  std::string name;  // "torso": Bullet and the renderer call it "<actor>/torso"
  geometry::Shape shape;
  int joint = 0;  // number of the frame that the motion moves
  base::Transform X_JL{};
  int material = 0;            // index into World::materials
  double texture_scale = 1.0;  // m per texture period
  bool collides = true;        // meshes collide as their convex hull
  bool casts_shadow = true;
};

/// A person on foot: along the route and back again (or round, where it is closed), as a social force and a gait have
/// it (social_force.h, gait.h). Joints as gait.h numbers them.
struct Walk {
  std::vector<base::Vec3> route{};              // on the ground, m; at least one point: one who stands there
  bool closed = false;                          // from the last point on to the first
  double start = 0.0;                           // m along the route
  double speed = 1.2;                           // m/s, as wished; 0: stands
  double height = 1.75;                         // m
  bool reactive = true;                         // to the vehicle; people always heed walls and each other
  std::shared_ptr<const HeightField> ground{};  // null: at the height of the route
};

/// A car with four wheels: along straight lines between the waypoints, joined by arcs (path.h). Joints: 0 chassis
/// (x forward, z up, origin on the ground under the middle of the rear axle), 1–4 wheels (front left, front right,
/// rear left, rear right; y along the axle).
struct Drive {
  std::vector<base::Vec3> waypoints{};  // on the ground, m; one alone: parked, looking along `heading`
  bool closed = false;                  // round and round; else it stops at the end
  double heading = 0.0;                 // rad, of one that is parked
  double start = 0.0;                   // m along the path
  double speed = 6.0;                   // m/s, at most
  double turn_radius = 6.0;             // m, of the arcs
  double wheelbase = 2.6;               // m
  double track = 1.5;                   // m
  double wheel_radius = 0.32;           // m
  double half_width = 0.9;              // m: what is closer than this to its path ahead is waited for
  bool reactive = true;                 // to the vehicle; cars always wait for people and cars in their way
  std::shared_ptr<const HeightField> ground{};
};

/// A multicopter that flies along arcs and lines between waypoints in the air. Joints: 0 body (FLU, between the
/// rotors).
struct Fly {
  std::vector<base::Vec3> waypoints{};  // m; one alone: hovers there
  bool closed = true;
  double start = 0.0;        // m along the path
  double speed = 2.0;        // m/s, at most
  double turn_radius = 1.5;  // m
  bool reactive = true;      // holds off from the vehicle, 2 m and more
};

/// A thing on a hinge: angle θ = amplitude · sin(2π (t / period + phase)) about the joint's x axis. Joint: 0, the
/// hinge, at rest at X_WH.
struct Swing {
  base::Transform X_WH{};
  double amplitude = 0.3;  // rad
  double period = 3.0;     // s
  double phase = 0.0;      // periods
};

/// Tufts of grass, each hinged at its root, that wind and the vehicle's downwash press over (grass.h). Joint i is tuft
/// i: upright, origin at its root.
struct Sway {
  std::vector<base::Transform> X_WR{};  // roots as they stand in still air
  double stiffness_speed = 6.0;         // m/s: a wind of this speed presses a tuft over by half a radian
  double frequency = 2.5;               // Hz, of its swinging
  double damping = 0.25;                // share of the critical one
};

using Motion = std::variant<Walk, Drive, Fly, Swing, Sway>;

/// What moves in a world besides the vehicle: solids on joint frames, and how these move. Data; ActorSimulation
/// (actor_simulation.h) moves it. What it draws comes from the stream "world/actors/<name>" of the run's seed.
struct Actor {
  std::string name;
  SemanticClass semantic = SemanticClass::kObstacle;
  std::vector<ActorLink> links{};
  Motion motion;
};

}  // namespace alula::worlds
