#include <btBulletDynamicsCommon.h>

#include <ctime>
#include <memory>
#include <vector>

#include "base/error.h"
#include "bench/bench.h"
#include "scenarios/runner.h"
#include "sim/knowledge.h"

namespace alula::bench {
namespace {

/// CPU time of this thread, s: a busy machine does not change it.
double CpuNow() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr int kTakeOff = 6000;   // steps until the vehicle hovers
constexpr int kMeasured = 8000;  // steps in the air

double MicrosecondsPerStep(double begin, int steps) { return (CpuNow() - begin) * 1e6 / steps; }

/// The same scene in Bullet alone: the world's objects and one box of the vehicle's mass that is held up by its weight.
class BareBullet {
 public:
  BareBullet(const worlds::World& world, const vehicles::VehicleBody& body, const base::Vec3& start) {
    world_.setGravity(btVector3(0, 0, -base::kGravity));
    world_.setForceUpdateAllAabbs(false);
    for (const worlds::Object& object : world.objects) {
      if (object.collides) AddStatic(object);
    }
    const base::Vec3& h = body.hull_half_extents;
    shapes_.push_back(std::make_unique<btBoxShape>(btVector3(h.x(), h.y(), h.z())));
    const base::Vec3 inertia = body.inertia.diagonal();
    btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, shapes_.back().get(),
                                                  btVector3(inertia.x(), inertia.y(), inertia.z()));
    info.m_startWorldTransform = btTransform(btQuaternion::getIdentity(), btVector3(start.x(), start.y(), start.z()));
    vehicle_ = std::make_unique<btRigidBody>(info);
    vehicle_->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(vehicle_.get());
    weight_ = btVector3(0, 0, body.mass * base::kGravity);
  }
  ~BareBullet() {
    world_.removeRigidBody(vehicle_.get());
    for (auto& object : objects_) world_.removeCollisionObject(object.get());
  }
  void Step() {
    vehicle_->applyCentralForce(weight_);
    world_.stepSimulation(1e-3, 0);
  }

 private:
  void AddStatic(const worlds::Object& object) {
    if (const auto* box = std::get_if<geometry::Box>(&object.shape)) {
      const base::Vec3& h = box->half_extents;
      shapes_.push_back(std::make_unique<btBoxShape>(btVector3(h.x(), h.y(), h.z())));
    } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&object.shape)) {
      shapes_.push_back(
          std::make_unique<btCylinderShapeZ>(btVector3(cylinder->radius, cylinder->radius, cylinder->half_height)));
    } else {
      throw base::FaultError("bench", "the bare scene knows boxes and cylinders; " + object.name + " is neither");
    }
    auto placed = std::make_unique<btCollisionObject>();
    placed->setCollisionShape(shapes_.back().get());
    const base::Transform& X = object.X_WO;
    placed->setWorldTransform(
        btTransform(btQuaternion(X.q.x(), X.q.y(), X.q.z(), X.q.w()), btVector3(X.p.x(), X.p.y(), X.p.z())));
    placed->forceActivationState(ISLAND_SLEEPING);
    world_.addCollisionObject(placed.get());
    objects_.push_back(std::move(placed));
  }

  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::unique_ptr<btRigidBody> vehicle_;
  btVector3 weight_{0, 0, 0};
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

double HoverStep(const scenarios::Scenario& scenario, Figures& figures, bool by_stage) {
  sim::SimulationParts parts = scenarios::BuildParts(scenario, {});
  parts.measure_time = by_stage;
  sim::Simulation simulation(std::move(parts));
  for (int i = 0; i < kTakeOff; ++i) simulation.Step();
  const std::vector<stack::StageTime> before = simulation.Timing();
  const auto begin = CpuNow();
  for (int i = 0; i < kMeasured; ++i) simulation.Step();
  const double us = MicrosecondsPerStep(begin, kMeasured);
  if (!by_stage) return us;
  const std::vector<stack::StageTime> after = simulation.Timing();
  for (std::size_t i = 0; i < before.size(); ++i) {
    figures.Add("dynamics/open_ground/" + after[i].name + "/step_us",
                (after[i].wall_ms - before[i].wall_ms) * 1e3 / kMeasured);
  }
  return us;
}

}  // namespace

/// A hovering quadrotor at 1 kHz with all sensors but cameras, autopilot and the scripted stack, beside Bullet alone.
void Run_dynamics(Figures& figures) {
  const scenarios::Scenario scenario = scenarios::LoadScenario(scenarios::FindScenario("hover"), {}, 1);
  const auto world = scenarios::MakeWorld(scenario.config.world, 1);
  const auto vehicle = scenarios::MakeVehicle(scenario.config.vehicle, "vehicle0");
  BareBullet bare(*world, vehicle->body(), world->X_WB_start.p + base::Vec3(0, 0, 1.5));
  for (int i = 0; i < kTakeOff; ++i) bare.Step();
  const auto begin = CpuNow();
  for (int i = 0; i < kMeasured; ++i) bare.Step();
  figures.Add("dynamics/open_ground/bare_bullet/step_us", MicrosecondsPerStep(begin, kMeasured));

  const double us = HoverStep(scenario, figures, false);
  figures.Add("dynamics/open_ground/hover/step_us", us);
  figures.Add("dynamics/open_ground/hover/real_time_factor", 1000.0 / us);
  HoverStep(scenario, figures, true);
}

}  // namespace alula::bench
