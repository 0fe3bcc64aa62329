#include "sim/physics_world.h"

#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "sim/internal/bullet_actors.h"
#include "sim/internal/bullet_shapes.h"

namespace alula::sim {
namespace {

using internal::FromBullet;
using internal::kVehicleGroup;
using internal::kWorldGroup;
using internal::ToBullet;

struct PrincipalAxes {
  base::Quat q_BP = base::Quat::Identity();
  base::Vec3 moments = base::Vec3::Ones();
};

/// Bullet's body frame must be the principal frame P of the inertia tensor.
PrincipalAxes Principal(const base::Mat3& inertia) {
  const base::Vec3 diagonal = inertia.diagonal();
  const base::Mat3 off = inertia - base::Mat3(diagonal.asDiagonal());
  if (off.cwiseAbs().maxCoeff() <= 1e-12 * diagonal.maxCoeff()) return {base::Quat::Identity(), diagonal};
  const Eigen::SelfAdjointEigenSolver<base::Mat3> eigen(inertia);
  base::Mat3 axes = eigen.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return {base::Quat(axes), eigen.eigenvalues()};
}

/// Distance between two axis-aligned boxes, a lower bound of that of what is inside.
double BoxDistance(const btVector3& low_a, const btVector3& high_a, const btVector3& low_b, const btVector3& high_b) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::max({0.0, low_a[i] - high_b[i], low_b[i] - high_a[i]});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

}  // namespace

struct PhysicsWorld::Impl {
  struct WorldObject {
    std::string name;
    std::unique_ptr<btCollisionObject> collision;
    btVector3 low, high;  // box, world axes
  };
  struct HullPart {
    std::string name;
    btConvexShape* shape = nullptr;
    btTransform X_BH;
  };
  struct CollidingPart {
    std::string name;
    bool may_touch = false;
  };

  internal::ShapeStore store;
  std::vector<WorldObject> objects;
  std::vector<HullPart> hull;
  std::vector<CollidingPart> parts;  // in the order of the compound's children
  std::unique_ptr<btRigidBody> vehicle;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  std::unique_ptr<internal::BulletActors> actors;  // null: there are none
  double hull_radius = 0.0;

  base::Transform X_PB;
  base::Vec3 moments = base::Vec3::Ones();
  vehicles::BodyState state;
  std::vector<Contact> contacts;

  void AddObjects(const worlds::World& description, const SurfaceConfig& surface);
  void AddVehicle(const vehicles::VehicleBody& body, const vehicles::BodyState& start, const SurfaceConfig& surface);
  void Place(const vehicles::BodyState& start);
  /// Rotation at the begin of a step; see PhysicsWorld.
  struct Spin {
    base::Mat3 R_WP;
    base::Vec3 L_W, w_middle_W;
  };
  base::Mat3 Attitude() const;
  base::Vec3 Momentum(const base::Mat3& R_WP, const base::Vec3& w_W) const {
    return R_WP * moments.cwiseProduct(R_WP.transpose() * w_W);
  }
  base::Vec3 Velocity(const base::Mat3& R_WP, const base::Vec3& L_W) const {
    return R_WP * (R_WP.transpose() * L_W).cwiseQuotient(moments);
  }
  Spin BeginRotation(base::Duration dt);
  void EndRotation(const Spin& spin);
  void ReadState();
  void ReadContacts();
  std::string_view NameOf(const btCollisionObject& object) const {
    const auto number = static_cast<std::size_t>(object.getUserIndex());
    return number < objects.size() ? std::string_view(objects[number].name) : actors->NameOf(object);
  }
};

void PhysicsWorld::Impl::AddObjects(const worlds::World& description, const SurfaceConfig& surface) {
  objects.reserve(description.objects.size());  // contacts refer to the names: they must not move
  for (const worlds::Object& object : description.objects) {
    if (!object.collides) continue;
    auto collision = std::make_unique<btCollisionObject>();
    collision->setCollisionShape(store.Make(object.shape, false));
    collision->setWorldTransform(ToBullet(object.X_WO));
    collision->setFriction(surface.friction);
    collision->setRestitution(surface.restitution);
    collision->setUserIndex(static_cast<int>(objects.size()));
    collision->forceActivationState(ISLAND_SLEEPING);  // a static body's box is not computed anew each step
    btVector3 low, high;
    collision->getCollisionShape()->getAabb(collision->getWorldTransform(), low, high);
    world.addCollisionObject(collision.get(), kWorldGroup, kVehicleGroup);
    objects.push_back({object.name, std::move(collision), low, high});
  }
}

void PhysicsWorld::Impl::AddVehicle(const vehicles::VehicleBody& body, const vehicles::BodyState& start,
                                    const SurfaceConfig& surface) {
  if (!body.prescribed && !(body.mass > 0.0)) throw base::FaultError("physics_setup", "the vehicle has no mass");
  const PrincipalAxes axes = body.prescribed ? PrincipalAxes{} : Principal(body.inertia);
  X_PB = {axes.q_BP.conjugate(), base::Vec3::Zero()};
  moments = axes.moments;

  btCompoundShape* compound = store.MakeCompound();
  parts.reserve(body.parts.size());
  hull.reserve(body.parts.size());
  for (const vehicles::Part& part : body.parts) {
    if (!part.collides && !part.hull) continue;
    btCollisionShape* shape = store.Make(part.shape, true);
    if (part.collides) {
      compound->addChildShape(ToBullet(X_PB * part.X_BP), shape);
      parts.push_back({part.name, part.may_touch});
    }
    if (part.hull) hull.push_back({part.name, static_cast<btConvexShape*>(shape), ToBullet(part.X_BP)});
  }

  const double mass = body.prescribed ? 0.0 : body.mass;
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, compound, ToBullet(moments));
  info.m_friction = surface.friction;
  info.m_restitution = surface.restitution;
  info.m_linearDamping = 0.0;
  info.m_angularDamping = 0.0;
  vehicle = std::make_unique<btRigidBody>(info);
  vehicle->setFlags(0);  // no gyroscopic force of Bullet's: BeginRotation and EndRotation do it
  if (body.prescribed) vehicle->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  vehicle->setActivationState(DISABLE_DEACTIVATION);
  vehicle->setSleepingThresholds(0.0, 0.0);
  Place(start);
  world.addRigidBody(vehicle.get(), kVehicleGroup, kWorldGroup);
}

void PhysicsWorld::Impl::Place(const vehicles::BodyState& start) {
  state = start;
  const btTransform X_WP = ToBullet(start.X_WB * X_PB.Inverse());
  vehicle->setWorldTransform(X_WP);
  vehicle->setInterpolationWorldTransform(X_WP);
  vehicle->setLinearVelocity(ToBullet(start.v_WB));
  vehicle->setAngularVelocity(ToBullet(base::Vec3(start.X_WB.q * start.w_B)));
  vehicle->updateInertiaTensor();
}

base::Mat3 PhysicsWorld::Impl::Attitude() const { return FromBullet(vehicle->getWorldTransform()).R(); }

PhysicsWorld::Impl::Spin PhysicsWorld::Impl::BeginRotation(base::Duration dt) {
  Spin spin;
  spin.R_WP = Attitude();
  const base::Vec3 w_W = FromBullet(vehicle->getAngularVelocity());
  spin.L_W = Momentum(spin.R_WP, w_W);
  spin.w_middle_W = Velocity(base::Exp(0.5 * dt.Seconds() * w_W).toRotationMatrix() * spin.R_WP, spin.L_W);
  vehicle->setAngularVelocity(ToBullet(spin.w_middle_W));
  return spin;
}

void PhysicsWorld::Impl::EndRotation(const Spin& spin) {
  const base::Vec3 w_W = FromBullet(vehicle->getAngularVelocity());
  const base::Vec3 L_W = spin.L_W + Momentum(spin.R_WP, w_W - spin.w_middle_W);
  vehicle->setAngularVelocity(ToBullet(Velocity(Attitude(), L_W)));
}

void PhysicsWorld::Impl::ReadState() {
  state.X_WB = FromBullet(vehicle->getWorldTransform()) * X_PB;
  state.v_WB = FromBullet(vehicle->getLinearVelocity());
  state.w_B = state.X_WB.q.conjugate() * FromBullet(vehicle->getAngularVelocity());
}

void PhysicsWorld::Impl::ReadContacts() {
  contacts.clear();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const bool vehicle_first = manifold.getBody0() == vehicle.get();
    const btCollisionObject* other = vehicle_first ? manifold.getBody1() : manifold.getBody0();
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.getDistance() > 0.0) continue;
      const int child = vehicle_first ? point.m_index0 : point.m_index1;
      const CollidingPart& part = parts[child >= 0 && child < static_cast<int>(parts.size()) ? child : 0];
      contacts.push_back({part.name, NameOf(*other), part.may_touch,
                          FromBullet(vehicle_first ? point.getPositionWorldOnB() : point.getPositionWorldOnA()),
                          point.getDistance()});
    }
  }
}

PhysicsWorld::PhysicsWorld(const worlds::World& world, const vehicles::VehicleBody& body,
                           const vehicles::BodyState& start, const SurfaceConfig& surface)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.world.setGravity(btVector3(0.0, 0.0, -base::kGravity));
  m.world.setForceUpdateAllAabbs(false);
  m.world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  // Penetration is undone by moving, never by a velocity (the vehicle would hop on its legs), down to a tenth of a
  // millimetre, which is left so that resting contacts persist.
  m.world.getSolverInfo().m_splitImpulse = 1;
  m.world.getSolverInfo().m_splitImpulsePenetrationThreshold = 0.0;
  m.world.getSolverInfo().m_linearSlop = 1e-4;
  m.AddObjects(world, surface);
  m.AddVehicle(body, start, surface);
  m.hull_radius = body.hull_radius;
  if (!world.actors.empty()) {
    m.actors = std::make_unique<internal::BulletActors>(world, surface, static_cast<int>(m.objects.size()), m.store);
  }
  DetectContacts();
}

PhysicsWorld::~PhysicsWorld() {
  impl_->world.removeRigidBody(impl_->vehicle.get());
  if (impl_->actors) impl_->actors->RemoveAll(impl_->world);
  for (auto& object : impl_->objects) impl_->world.removeCollisionObject(object.collision.get());
}

void PhysicsWorld::MoveActors(const worlds::ActorSimulation& actors, base::Time t) {
  constexpr double kNear = 1.0;  // m
  Impl& m = *impl_;
  if (m.actors) m.actors->Move(m.world, actors, t, m.state.X_WB.p, m.hull_radius + kNear);
}

void PhysicsWorld::Step(const vehicles::Wrench& wrench, base::Duration dt) {
  Impl& m = *impl_;
  const Impl::Spin spin = m.BeginRotation(dt);
  m.vehicle->applyCentralForce(ToBullet(wrench.force_W));
  m.vehicle->applyTorque(ToBullet(wrench.torque_W));
  m.world.stepSimulation(dt.Seconds(), 0);  // 0 substeps: exactly one step of dt
  m.EndRotation(spin);
  m.ReadState();
  m.ReadContacts();
}

void PhysicsWorld::MovePrescribed(const vehicles::BodyState& state) {
  impl_->Place(state);
  DetectContacts();
}

void PhysicsWorld::DetectContacts() {
  impl_->world.performDiscreteCollisionDetection();
  impl_->ReadContacts();
}

const vehicles::BodyState& PhysicsWorld::state() const { return impl_->state; }
std::span<const Contact> PhysicsWorld::contacts() const { return impl_->contacts; }

Clearance PhysicsWorld::HullClearance(double reach, std::span<const std::string_view> except) const {
  const Impl& m = *impl_;
  const btTransform X_WB = ToBullet(m.state.X_WB);
  Clearance best{reach, {}, {}};
  for (const Impl::HullPart& part : m.hull) {
    const btTransform X_WH = X_WB * part.X_BH;
    btVector3 low, high;
    part.shape->getAabb(X_WH, low, high);
    for (const Impl::WorldObject& object : m.objects) {
      if (BoxDistance(low, high, object.low, object.high) >= best.distance) continue;
      if (std::find(except.begin(), except.end(), object.name) != except.end()) continue;
      const double d = internal::Distance(*part.shape, X_WH, *object.collision->getCollisionShape(),
                                          object.collision->getWorldTransform(), std::max(best.distance, 0.0));
      if (d < best.distance) best = {d, part.name, object.name};
    }
  }
  if (!m.actors) return best;
  for (const auto& link : m.actors->Within(m.state.X_WB.p, m.hull_radius + std::max(best.distance, 0.0))) {
    const std::string_view name = m.actors->NameOf(*link.body);
    if (std::find(except.begin(), except.end(), name) != except.end()) continue;
    btVector3 link_low, link_high;
    link.body->getCollisionShape()->getAabb(link.body->getWorldTransform(), link_low, link_high);
    for (const Impl::HullPart& part : m.hull) {
      const btTransform X_WH = X_WB * part.X_BH;
      btVector3 low, high;
      part.shape->getAabb(X_WH, low, high);
      if (BoxDistance(low, high, link_low, link_high) >= best.distance) continue;
      const double d = internal::Distance(*part.shape, X_WH, *link.body->getCollisionShape(),
                                          link.body->getWorldTransform(), std::max(best.distance, 0.0));
      if (d < best.distance) best = {d, part.name, name};
    }
  }
  return best;
}

std::optional<RayHit> PhysicsWorld::CastRay(const base::Vec3& from_W, const base::Vec3& to_W) const {
  const btVector3 from = ToBullet(from_W);
  const btVector3 to = ToBullet(to_W);
  btCollisionWorld::ClosestRayResultCallback hit(from, to);
  hit.m_collisionFilterGroup = kVehicleGroup;  // sees what the vehicle can meet: the world
  hit.m_collisionFilterMask = kWorldGroup;
  impl_->world.rayTest(from, to, hit);
  if (impl_->actors) {
    const btTransform X_from(btQuaternion::getIdentity(), from), X_to(btQuaternion::getIdentity(), to);
    for (const auto& link : impl_->actors->Within(0.5 * (from_W + to_W), 0.5 * (to_W - from_W).norm())) {
      if (link.present) continue;
      auto* body = const_cast<btRigidBody*>(link.body);  // a ray changes nothing; Bullet's signature forgot
      btCollisionWorld::rayTestSingle(X_from, X_to, body, body->getCollisionShape(), body->getWorldTransform(), hit);
    }
  }
  if (!hit.hasHit()) return std::nullopt;
  const base::Vec3 point = FromBullet(hit.m_hitPointWorld);
  return RayHit{hit.m_closestHitFraction * (to_W - from_W).norm(), point, impl_->NameOf(*hit.m_collisionObject)};
}

}  // namespace alula::sim
