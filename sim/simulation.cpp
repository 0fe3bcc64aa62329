#include "sim/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <numeric>
#include <span>
#include <utility>

#include "base/error.h"
#include "sim/faults/scope.h"
#include "sim/finite.h"
#include "sim/gate_crossing.h"
#include "sim/knowledge.h"

namespace alula::sim {
namespace {

/// Wall time, for timing.json only.
std::int64_t WallNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

vehicles::BodyState StartState(const SimulationParts& parts) {
  const vehicles::VehicleBody& body = parts.vehicle->body();
  if (body.prescribed) return parts.vehicle->Prescribed({0});
  return {StartPose(*parts.world, body.standing_height), base::Vec3::Zero(), base::Vec3::Zero()};
}

/// Infinite where one of them has nothing below, or none is known.
double MeanHeight(std::span<const double> heights) {
  if (heights.empty()) return std::numeric_limits<double>::infinity();
  return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

/// Runs what calls the stack; what that throws is a fault of the stack.
template <typename Call>
auto AskStack(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw base::FaultError("memory", "the stack asked for more memory than there is");
  } catch (const std::exception& e) {
    throw base::FaultError("stack_exception", e.what());
  } catch (...) {
    throw base::FaultError("stack_exception", "the stack threw something that is no std::exception");
  }
}

}  // namespace

void Describe(base::Description& d, SimulationConfig& c) {
  d.Field("step", c.step, {.unit = "s", .meaning = "physics and autopilot period", .min = 1e-4, .max = 0.01});
  d.Field("link_delay", c.link_delay, {.unit = "s", .meaning = "between stack and autopilot, each way", .min = 0});
  d.Field("friction", c.surface.friction, {.unit = "1", .meaning = "Coulomb friction of all surfaces", .min = 0});
  d.Field("restitution", c.surface.restitution, {.unit = "1", .meaning = "bounce of all surfaces", .min = 0, .max = 1});
  d.Field("magnetic_field", c.magnetic_field, {.meaning = "Earth's field at this place"});
}

Simulation::Simulation(SimulationParts parts)
    : parts_(std::move(parts)),
      actors_(*parts_.world, parts_.seed),
      physics_(std::make_unique<PhysicsWorld>(*parts_.world, parts_.vehicle->body(), StartState(parts_),
                                              parts_.config.surface)),
      sensors_(parts_.sensors, parts_.vehicle->body(), parts_.config.step, parts_.seed, parts_.vehicle_id,
               parts_.renderer.get(), parts_.workers, parts_.world->light, &actors_),
      autopilot_imu_(parts_.autopilot_sensors.imu, parts_.config.step, parts_.seed,
                     parts_.vehicle_id + "/autopilot.imu"),
      autopilot_barometer_(parts_.autopilot_sensors.barometer, parts_.seed, parts_.vehicle_id + "/autopilot.barometer"),
      wind_(*parts_.world, parts_.seed),
      B_W_(FluxDensity(parts_.config.magnetic_field)) {
  if (!actors_.empty()) {
    physics_->MoveActors(actors_, {0});
    physics_->DetectContacts();
  }
  truth_ = {{0}, {0}, physics_->state(), physics_->state(), {.B_W = B_W_}};
  sensors_.Settle(truth_.at_end);
  autopilot_imu_.Settle(truth_.at_end);
  if (parts_.faults.empty()) return;
  const faults::Scope scope = faults::ScopeOf(parts_.sensors, *parts_.vehicle, *parts_.world, parts_.vehicle_id,
                                              parts_.autopilot != nullptr, parts_.stack != nullptr);
  injector_ = std::make_unique<faults::Injector>(parts_.faults, scope, parts_.seed);
  sensors_.Break(injector_.get());
}

Simulation::~Simulation() = default;

std::optional<std::string> Simulation::Step() {
  if (parts_.measure_time) lap_ns_ = WallNow();
  if (injector_) StepFaults();
  sensors_.Measure(truth_, {parts_.vehicle->Battery(), autopilot_output_.status, parts_.config.link_delay});
  sensors_.Collect(time_, measurements_);
  Lap(kSensors);
  StepStack();
  Lap(kStack);
  StepAutopilot();
  Lap(kAutopilot);
  StepBody();
  const std::optional<std::string> reason = StepObservers();
  Lap(kObservers);
  ++steps_;
  return reason;
}

void Simulation::StepFaults() {
  const worlds::World& world = *parts_.world;
  if (static_cast<std::size_t>(gates_passed_) < world.gates.size()) {
    const auto crossing = CrossingOf(world.gates[static_cast<std::size_t>(gates_passed_)], actors_, truth_);
    if (crossing && crossing->forward) ++gates_passed_;
  }
  const vehicles::BodyState& now = truth_.at_end;
  const bool changed = injector_->Advance({.now = time_,
                                           .height = now.X_WB.p.z() - world.X_WB_start.p.z(),
                                           .speed = now.v_WB.norm(),
                                           .target_distance = (now.X_WB.p - world.target).norm(),
                                           .gates_passed = gates_passed_,
                                           .mode = autopilot_output_.status.mode});
  if (!changed) return;
  const faults::Impairments& broken = injector_->impairments();
  parts_.vehicle->Impair(broken.vehicle);
  sensors_.Soil(broken.dirt);
  SlowComputer(broken.computer);
}

void Simulation::SlowComputer(double factor) {
  if (factor == computer_factor_) return;
  computer_factor_ = factor;
  const bool heeded = AskStack([&] { return parts_.stack->SetComputeFactor(factor); });
  if (heeded || factor == 1.0) return;
  injector_->Say(time_, "fault_ignored", "this stack declares no latencies: the speed of its computer changes nothing");
}

void Simulation::StepStack() {
  if (!parts_.stack) return;
  output_ = AskStack([this] { return parts_.stack->Step(time_, measurements_); });
  if (const std::string wrong = FirstNonFinite(output_); !wrong.empty()) {
    throw base::FaultError("stack_nan", "the stack's " + wrong + " is not finite");
  }
  const base::Time due = time_ + parts_.config.link_delay;
  const bool lost = injector_ && injector_->impairments().commands_lost;
  if (output_.estimate && !lost) link_.push_back({due, *output_.estimate});
  for (const stack::Command& command : output_.commands) {
    const bool to_gimbal = std::holds_alternative<stack::GimbalSetpoint>(command.what);
    if (to_gimbal || !lost) link_.push_back({due, command});
  }
}

void Simulation::StepLink() {
  while (!link_.empty() && link_.front().due <= time_) {
    const auto* command = std::get_if<stack::Command>(&link_.front().what);
    const auto* turn = command != nullptr ? std::get_if<stack::GimbalSetpoint>(&command->what) : nullptr;
    if (turn != nullptr) {
      sensors_.Obey(*turn);
    } else if (parts_.autopilot) {
      std::visit([this](const auto& what) { parts_.autopilot->Receive(time_, what); }, link_.front().what);
    }
    link_.pop_front();
  }
}

void Simulation::StepAutopilot() {
  StepLink();
  if (!parts_.autopilot) return;
  vehicles::AutopilotSensors sensors;
  sensors.imu = autopilot_imu_.Sample();
  const base::Rate rate = parts_.autopilot_sensors.barometer.rate;
  if (rate.SampleTime(autopilot_barometer_n_) <= time_) {
    sensors.barometer =
        autopilot_barometer_.Sample(truth_.At(rate.SampleTime(autopilot_barometer_n_)).X_WB.p.z(), truth_.ambience);
    ++autopilot_barometer_n_;
  }
  sensors.battery_voltage = parts_.vehicle->Battery().voltage;
  if (injector_) sensors = autopilot_line_.Pass(time_, sensors, *injector_);
  autopilot_output_ = parts_.autopilot->Step(time_, sensors);
  for (const double motor : autopilot_output_.actuators.motors) {
    if (!std::isfinite(motor)) throw base::FaultError("autopilot_nan", "a motor command is not finite");
  }
}

void Simulation::LookBelow(const vehicles::BodyState& state) {
  const double reach = std::max({parts_.vehicle->GroundReach(), GroundReach(parts_.autopilot_sensors.barometer),
                                 parts_.sensors.barometer ? GroundReach(*parts_.sensors.barometer) : 0.0});
  if (reach <= 0.0) return;
  rotor_heights_.clear();
  for (const vehicles::RotorState& rotor : parts_.vehicle->Rotors()) {
    const base::Vec3 hub_W = state.X_WB * rotor.p_BR;
    const auto hit = physics_->CastRay(hub_W, hub_W - base::Vec3(0.0, 0.0, reach));
    rotor_heights_.push_back(hit ? hit->distance : std::numeric_limits<double>::infinity());
  }
  parts_.vehicle->Above(rotor_heights_);
}

void Simulation::StepBody() {
  const base::Duration dt = parts_.config.step;
  const vehicles::BodyState before = physics_->state();
  wind_W_ = wind_.At(before.X_WB.p, dt, before.v_WB);
  LookBelow(before);
  const vehicles::Wrench wrench = parts_.vehicle->Step(before, autopilot_output_.actuators, wind_W_, dt);
  Lap(kVehicle);
  MoveActors(before, wrench);
  if (parts_.vehicle->body().prescribed) {
    physics_->MovePrescribed(parts_.vehicle->Prescribed(time_ + dt));
  } else {
    physics_->Step(wrench, dt);
  }
  Lap(kPhysics);
  const vehicles::BodyState& after = physics_->state();
  if (!IsFinite(after)) throw base::FaultError("numerical", "the vehicle's true state is not finite");
  const Ambience ambience{.rotors = parts_.vehicle->Rotors(),
                          .v_air_B = after.X_WB.q.conjugate() * (after.v_WB - wind_W_),
                          .rotor_height = MeanHeight(rotor_heights_),
                          .B_W = B_W_};
  sensors_.Integrate(time_ + dt, before, after, ambience);
  autopilot_imu_.Integrate(before, after, parts_.vehicle->Rotors());
  truth_ = {time_, time_ + dt, before, after, ambience};
  time_ += dt;
  Lap(kSensors);
}

void Simulation::MoveActors(const vehicles::BodyState& vehicle, const vehicles::Wrench& wrench) {
  if (actors_.empty()) return;
  const double thrust = wrench.force_W.dot(vehicle.X_WB.q * base::Vec3::UnitZ());
  const base::Time end = time_ + parts_.config.step;
  actors_.Advance(end,
                  {vehicle.X_WB.p, vehicle.v_WB, parts_.vehicle->body().hull_radius, std::max(thrust, 0.0), wind_W_});
  physics_->MoveActors(actors_, end);
}

std::optional<std::string> Simulation::StepObservers() {
  const StepView view{.time = time_,
                      .truth = truth_,
                      .contacts = physics_->contacts(),
                      .measurements = measurements_,
                      .output = parts_.stack ? &output_ : nullptr,
                      .status = autopilot_output_.status,
                      .actuators = autopilot_output_.actuators,
                      .wind_W = wind_W_,
                      .physics = *physics_,
                      .vehicle = *parts_.vehicle,
                      .autopilot = parts_.autopilot.get(),
                      .world = *parts_.world,
                      .actors = actors_,
                      .imu_bias = sensors_.imu_bias(),
                      .fault_events = injector_ ? injector_->events() : std::span<const stack::StackEvent>()};
  std::optional<std::string> reason;
  for (Observer* observer : parts_.observers) {
    std::optional<std::string> wish = observer->Observe(view);
    if (!reason) reason = std::move(wish);
  }
  const std::optional<base::Time> end = parts_.vehicle->PrescribedEnd();
  if (!reason && end && time_ >= *end) reason = "prescribed_end";
  return reason;
}

void Simulation::Lap(Stage stage) {
  if (!parts_.measure_time) return;
  const std::int64_t now = WallNow();
  stage_ns_[stage] += now - lap_ns_;
  lap_ns_ = now;
}

std::vector<stack::StageTime> Simulation::Timing() const {
  constexpr const char* kNames[kStages] = {"sensors", "stack", "autopilot", "vehicle", "physics", "observers"};
  std::vector<stack::StageTime> stages;
  for (int i = 0; i < kStages; ++i) {
    stages.push_back({kNames[i], static_cast<double>(stage_ns_[i]) * 1e-6, steps_, 0.0});
  }
  if (HasCameras(parts_.sensors)) stages.push_back({"sensors/render", sensors_.render_ms(), 0, 0.0});
  if (parts_.stack) {
    for (stack::StageTime stage : parts_.stack->Timing()) {
      stage.name = "stack/" + stage.name;
      stages.push_back(std::move(stage));
    }
  }
  return stages;
}

std::vector<stack::StackFile> Simulation::StackFiles() const {
  if (!parts_.stack) return {};
  try {
    return parts_.stack->Files();
  } catch (const std::exception& e) {
    throw base::FaultError("stack_exception", e.what());
  }
}

}  // namespace alula::sim
