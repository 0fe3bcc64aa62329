#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "sim/faults/autopilot_sensors.h"
#include "sim/faults/injector.h"
#include "sim/magnetic_field.h"
#include "sim/observer.h"
#include "sim/physics_world.h"
#include "sim/sensors/suite.h"
#include "sim/truth.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/wind.h"

namespace alula::sim {

struct SimulationConfig {
  base::Duration step = base::Milliseconds(1);        // physics period, and the autopilot's
  base::Duration link_delay = base::Milliseconds(5);  // stack ↔ autopilot, each way
  SurfaceConfig surface;
  MagneticFieldConfig magnetic_field;
};
void Describe(base::Description& d, SimulationConfig& c);

/// All that a simulation is made of. Concrete types are chosen by whoever composes; the simulation knows interfaces.
struct SimulationParts {
  SimulationConfig config;
  SensorsConfig sensors;
  AutopilotSensorsConfig autopilot_sensors;
  std::vector<sim::faults::Config> faults;
  std::shared_ptr<const worlds::World> world;
  std::unique_ptr<vehicles::VehicleModel> vehicle;
  std::unique_ptr<vehicles::Autopilot> autopilot;    // null: the motors stay off
  std::unique_ptr<stack::NavigationStack> stack;     // null: nobody listens to the sensors
  std::unique_ptr<render::CameraRenderer> renderer;  // needed where there are cameras
  std::vector<Observer*> observers;                  // in this order; they outlive the simulation
  std::string vehicle_id = "vehicle0";
  std::uint64_t seed = 1;
  int workers = 1;           // 2 and more: pictures are drawn on two threads of their own
  bool measure_time = true;  // keep stage times (clocks are read, nothing depends on them)
};

/// The closed loop. One step from t to t + dt:
///
///   1. faults of the scenario that are due begin and end; what they do to vehicle, lenses and computer is set
///   2. sensors whose sample time lies in (t − dt, t] measure the truth with their own random streams; faults lose a
///      measurement, delay it, or change it on its arrival
///   3. stack.Step(t, measurements with available ≤ t)           → commands, estimate, events
///   4. commands and estimate reach the autopilot (or a gimbal) once the link delay has passed
///   5. autopilot.Step(t, its own sensors)                       → motor commands
///   6. vehicle.Step(state at t, wind)                           → force and torque
///   7. actors move to t + dt, heeding the true state at t
///   8. Bullet steps to t + dt (a prescribed vehicle is put where it is then); contacts are read
///   9. observers look at the step; one may end the run with a named reason
///
/// Deterministic: everything follows from the parts and the seed.
class Simulation {
 public:
  /// Throws base::InputError where faults, sensors or light do not fit the rest.
  explicit Simulation(SimulationParts parts);
  ~Simulation();

  /// One step. Returns the reason when an observer (or the end of a prescribed motion: "prescribed_end") ends the run.
  /// Throws base::FaultError: "stack_exception", "stack_nan", "autopilot_nan", "numerical".
  std::optional<std::string> Step();

  base::Time time() const { return time_; }
  const TruthWindow& truth() const { return truth_; }
  const PhysicsWorld& physics() const { return *physics_; }
  const worlds::ActorSimulation& actors() const { return actors_; }
  /// Wall time by stage in ms, the stack's own stages included ("stack/…").
  std::vector<stack::StageTime> Timing() const;
  /// What the stack leaves behind; none without a stack. Throws base::FaultError: "stack_exception".
  std::vector<stack::StackFile> StackFiles() const;

 private:
  struct InFlight {
    base::Time due;
    std::variant<stack::Command, stack::Estimate> what;
  };
  enum Stage { kSensors, kStack, kAutopilot, kVehicle, kPhysics, kObservers, kStages };

  void StepFaults();
  void SlowComputer(double factor);
  void StepStack();
  void StepLink();
  void StepAutopilot();
  /// How high the rotors are, where something asks for it.
  void LookBelow(const vehicles::BodyState& state);
  void StepBody();
  void MoveActors(const vehicles::BodyState& vehicle, const vehicles::Wrench& wrench);
  std::optional<std::string> StepObservers();
  void Lap(Stage stage);

  SimulationParts parts_;
  worlds::ActorSimulation actors_;
  std::unique_ptr<PhysicsWorld> physics_;
  std::unique_ptr<faults::Injector> injector_;  // null: nothing goes wrong
  faults::AutopilotSensorLine autopilot_line_;
  int gates_passed_ = 0;  // for conditions of faults
  double computer_factor_ = 1.0;
  SensorSuite sensors_;
  Imu autopilot_imu_;
  Barometer autopilot_barometer_;
  std::int64_t autopilot_barometer_n_ = 0;
  worlds::WindField wind_;
  base::Vec3 B_W_;  // magnetic flux density, T

  base::Time time_;
  TruthWindow truth_;
  base::Vec3 wind_W_ = base::Vec3::Zero();
  std::vector<double> rotor_heights_;  // above what lies below, m; empty: not asked for
  std::vector<stack::Measurement> measurements_;
  stack::StackOutput output_;
  std::deque<InFlight> link_;
  vehicles::AutopilotOutput autopilot_output_;

  std::uint64_t steps_ = 0;
  std::int64_t lap_ns_ = 0;
  std::int64_t stage_ns_[kStages] = {};
};

}  // namespace alula::sim
