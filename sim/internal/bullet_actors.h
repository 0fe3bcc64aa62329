#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/internal/bullet_shapes.h"
#include "sim/physics_world.h"

namespace alula::sim::internal {

/// Groups that let a prescribed (kinematic) vehicle meet static objects, which Bullet's defaults do not.
inline constexpr int kVehicleGroup = 1;
inline constexpr int kWorldGroup = 2;

/// The links of a world's actors as kinematic bodies. Those of actors that are far from the place of interest are not
/// in Bullet's world at all; they enter and leave it in a fixed order.
class BulletActors {
 public:
  /// `first_number`: user index of the first link. The shapes live in `store`.
  BulletActors(const worlds::World& world, const SurfaceConfig& surface, int first_number, ShapeStore& store);

  /// At time t, within `reach` m of p_W; Bullet's own step then gives the links the velocity of their motion.
  void Move(btDiscreteDynamicsWorld& world, const worlds::ActorSimulation& actors, base::Time t, const base::Vec3& p_W,
            double reach);
  void RemoveAll(btDiscreteDynamicsWorld& world);

  /// The links of all actors within `reach` m of p_W at the time of the last Move, in their order. Bullet's world stays
  /// as it is: who asks changes nothing.
  struct Seen {
    const btRigidBody* body = nullptr;
    bool present = false;  // in Bullet's world
  };
  const std::vector<Seen>& Within(const base::Vec3& p_W, double reach);
  std::string_view NameOf(const btCollisionObject& link) const {
    return names_[static_cast<std::size_t>(link.getUserIndex() - first_number_)];
  }

 private:
  struct Link {
    std::size_t number = 0;  // among its actor's links
    std::unique_ptr<btRigidBody> body;
  };
  struct Group {            // the links of one actor that collide
    std::size_t links = 0;  // all of its links
    std::vector<Link> solid;
    bool present = false;
  };
  void Place(std::size_t actor);
  void Enter(btDiscreteDynamicsWorld& world, Group& group);
  void Leave(btDiscreteDynamicsWorld& world, Group& group);

  std::vector<Group> groups_;  // by actor
  std::vector<std::string> names_;
  int first_number_ = 0;
  std::vector<Seen> seen_;
  const worlds::ActorSimulation* actors_ = nullptr;
  base::Time time_;
  std::vector<base::Transform> X_WL_;
};

}  // namespace alula::sim::internal
