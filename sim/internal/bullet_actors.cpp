#include "sim/internal/bullet_actors.h"

namespace alula::sim::internal {

BulletActors::BulletActors(const worlds::World& world, const SurfaceConfig& surface, int first_number,
                           ShapeStore& store)
    : first_number_(first_number) {
  for (const worlds::Actor& actor : world.actors) {
    Group& group = groups_.emplace_back();
    group.links = actor.links.size();
    for (std::size_t i = 0; i < actor.links.size(); ++i) {
      const worlds::ActorLink& link = actor.links[i];
      if (!link.collides) continue;
      btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, store.Make(link.shape, true));
      info.m_friction = surface.friction;
      info.m_restitution = surface.restitution;
      auto body = std::make_unique<btRigidBody>(info);
      body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
      body->setActivationState(DISABLE_DEACTIVATION);
      body->setUserIndex(first_number + static_cast<int>(names_.size()));
      names_.push_back(actor.name + "/" + link.name);
      group.solid.push_back({i, std::move(body)});
    }
  }
}

void BulletActors::Place(std::size_t actor) {
  Group& group = groups_[actor];
  X_WL_.resize(group.links);
  actors_->PlaceLinks(actor, time_, X_WL_);
  for (const Link& link : group.solid) link.body->setWorldTransform(ToBullet(X_WL_[link.number]));
}

void BulletActors::Enter(btDiscreteDynamicsWorld& world, Group& group) {
  if (group.present) return;
  group.present = true;
  for (const Link& link : group.solid) {
    link.body->setInterpolationWorldTransform(link.body->getWorldTransform());  // it did not come from anywhere
    link.body->setLinearVelocity(btVector3(0.0, 0.0, 0.0));
    link.body->setAngularVelocity(btVector3(0.0, 0.0, 0.0));
    world.addRigidBody(link.body.get(), kWorldGroup, kVehicleGroup);
  }
}

void BulletActors::Leave(btDiscreteDynamicsWorld& world, Group& group) {
  if (!group.present) return;
  group.present = false;
  for (const Link& link : group.solid) world.removeRigidBody(link.body.get());
}

void BulletActors::Move(btDiscreteDynamicsWorld& world, const worlds::ActorSimulation& actors, base::Time t,
                        const base::Vec3& p_W, double reach) {
  actors_ = &actors;
  time_ = t;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    if (groups_[i].solid.empty()) continue;
    const double near = actors.Reach(i) + reach;
    if ((actors.RootPose(i, t).p - p_W).squaredNorm() <= near * near) {
      Place(i);
      Enter(world, groups_[i]);
    } else {
      Leave(world, groups_[i]);
    }
  }
}

const std::vector<BulletActors::Seen>& BulletActors::Within(const base::Vec3& p_W, double reach) {
  seen_.clear();
  for (std::size_t i = 0; actors_ != nullptr && i < groups_.size(); ++i) {
    if (groups_[i].solid.empty()) continue;
    const double near = actors_->Reach(i) + reach;
    if ((actors_->RootPose(i, time_).p - p_W).squaredNorm() > near * near) continue;
    if (!groups_[i].present) Place(i);
    for (const Link& link : groups_[i].solid) seen_.push_back({link.body.get(), groups_[i].present});
  }
  return seen_;
}

void BulletActors::RemoveAll(btDiscreteDynamicsWorld& world) {
  for (Group& group : groups_) Leave(world, group);
}

}  // namespace alula::sim::internal
