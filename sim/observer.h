#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/time.h"
#include "sim/physics_world.h"
#include "sim/truth.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"
#include "vehicles/vehicle.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/world.h"

namespace alula::sim {

/// All of one step of the loop, the truth included. Valid during the call only (measurements may be copied: images
/// share their bytes).
struct StepView {
  base::Time time;                                   // the end of the step
  const TruthWindow& truth;                          // motion from the step's begin to its end
  std::span<const Contact> contacts;                 // at its end
  std::span<const stack::Measurement> measurements;  // what the stack was given at its begin
  const stack::StackOutput* output = nullptr;        // what the stack answered; null where no stack flies
  const stack::VehicleStatus& status;                // the autopilot's, at its begin
  const vehicles::ActuatorCommand& actuators;
  const base::Vec3& wind_W;  // at the vehicle, m/s
  const PhysicsWorld& physics;
  const vehicles::VehicleModel& vehicle;
  const vehicles::Autopilot* autopilot = nullptr;
  const worlds::World& world;
  const worlds::ActorSimulation& actors;              // known up to the step's end
  ImuBias imu_bias;                                   // true, of the stack's IMU; zero where there is none
  std::span<const stack::StackEvent> fault_events{};  // faults of the scenario that began or ended at its begin
};

/// Looks at every step: recorders, criteria, pictures. It changes nothing in the loop.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A short snake_case word ends the run with that reason; the first observer that gives one decides, the others
  /// still see the step.
  virtual std::optional<std::string> Observe(const StepView& step) = 0;
};

}  // namespace alula::sim
