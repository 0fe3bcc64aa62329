#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "vehicles/vehicle.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/world.h"

namespace alula::sim {

/// A touch between a part of the vehicle and an object of the world (manifold distance ≤ 0). Names live as long as the
/// physics world.
struct Contact {
  std::string_view part;
  std::string_view object;
  bool may_touch = false;                   // the part's own licence (legs)
  base::Vec3 point_W = base::Vec3::Zero();  // on the object's surface, m
  double distance = 0.0;                    // ≤ 0: penetration, m
};

/// The smallest distance between hull and world; negative when they overlap.
struct Clearance {
  double distance = 0.0;  // m
  std::string_view part;
  std::string_view object;
};

struct RayHit {
  double distance = 0.0;  // from the ray's start, m
  base::Vec3 point_W = base::Vec3::Zero();
  std::string_view object;
};

/// How surfaces meet; one value for the whole world.
struct SurfaceConfig {
  double friction = 0.8;
  double restitution = 0.1;
};

/// The rigid-body world: one vehicle among static objects and actors, in Bullet with double precision.
///
/// One `Step`: the wrench and gravity act at the centre of mass for dt, contacts are solved, the body moves
/// (semi-implicit Euler). The gyroscopic term is not Bullet's. With J(R) = R I Rᵀ and L = J(R_k) ω_k,
///   ω_½ = J(Exp(½ dt ω_k) R_k)⁻¹ L             what the attitude turns with (explicit midpoint)
///   Bullet: ω' = ω_½ + torques and contact impulses, R_{k+1} = Exp(dt ω') R_k
///   ω_{k+1} = J(R_{k+1})⁻¹ (L + J(R_k) (ω' − ω_½))
/// so that free rotation keeps the angular momentum to rounding and its energy to second order.
///
/// Actors are kinematic: they push and are not pushed, with the velocity of their links. Only those within 1 m of the
/// hull are in Bullet's world; clearance and rays see all of them.
///
/// Deterministic: fixed order of bodies, ordered overlapping pairs, no deactivation.
class PhysicsWorld {
 public:
  /// `ignored_objects` of the world are those whose `collides` is false. Throws base::FaultError("physics_setup").
  PhysicsWorld(const worlds::World& world, const vehicles::VehicleBody& body, const vehicles::BodyState& start,
               const SurfaceConfig& surface = {});
  ~PhysicsWorld();
  PhysicsWorld(const PhysicsWorld&) = delete;
  PhysicsWorld& operator=(const PhysicsWorld&) = delete;

  /// Puts the actors of the world where they are at t. `actors` must outlive this world; call it before the step or
  /// the move that ends at t. Without a call they are not there.
  void MoveActors(const worlds::ActorSimulation& actors, base::Time t);
  /// Advances by dt (one Bullet step) under a wrench about the centre of mass, world axes; gravity is added here.
  void Step(const vehicles::Wrench& wrench, base::Duration dt);
  /// Puts a prescribed vehicle at a state and reads what it touches.
  void MovePrescribed(const vehicles::BodyState& state);

  const vehicles::BodyState& state() const;
  /// Contacts of the last step, in a fixed order.
  std::span<const Contact> contacts() const;
  /// What touches at the present pose; for the instant before the first step.
  void DetectContacts();

  /// The smallest hull distance by GJK, not looked for beyond `reach` (m): a result ≥ reach means "at least".
  /// Objects named in `except` do not count.
  Clearance HullClearance(double reach, std::span<const std::string_view> except = {}) const;
  /// The first object on the segment (the vehicle is transparent).
  std::optional<RayHit> CastRay(const base::Vec3& from_W, const base::Vec3& to_W) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::sim
