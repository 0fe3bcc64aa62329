#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "sim/run_digest.h"
#include "sim/simulation.h"
#include "tests/sim/test_world.h"

namespace alula::sim::testing {

/// A scenario's key `faults` alone.
struct FaultList {
  std::vector<faults::Config> faults;
};
inline void Describe(base::Description& d, FaultList& c) { faults::DescribeFaults(d, c.faults); }

/// `list`: as YAML has it, "[{type: drop, …}]".
inline std::vector<faults::Config> Read(const std::string& list) {
  return base::ReadConfig<FaultList>(base::YamlDocument::Parse("faults: " + list, "f.yaml"), 1).faults;
}

/// Four motors and a battery that note how they are impaired; carries its weight, come what may.
class FragileVehicle : public vehicles::VehicleModel {
 public:
  explicit FragileVehicle(std::vector<vehicles::Impairment>& notes) : body_(PlateOnLegs()), notes_(notes) {}
  const vehicles::VehicleBody& body() const override { return body_; }
  vehicles::Wrench Step(const vehicles::BodyState&, const vehicles::ActuatorCommand&, const base::Vec3&,
                        base::Duration) override {
    return {.force_W = {0, 0, base::kGravity + 0.1}, .torque_W = base::Vec3::Zero()};
  }
  int Motors() const override { return 4; }
  void Impair(const vehicles::Impairment& broken) override { notes_.push_back(broken); }
  stack::BatterySample Battery() const override { return {16.0, 1.0}; }
  std::vector<vehicles::TelemetryValue> Telemetry() const override { return {}; }

 private:
  vehicles::VehicleBody body_;
  std::vector<vehicles::Impairment>& notes_;
};

/// All that one flight of 600 ms showed.
struct FaultyFlight {
  std::vector<std::vector<stack::Measurement>> given;                  // by step, to the stack
  std::vector<vehicles::AutopilotSensors> sensors;                     // by step, to the autopilot
  std::vector<std::pair<base::Time, base::Time>> commands, estimates;  // received, issued
  std::vector<vehicles::Impairment> impairments;
  std::vector<std::pair<base::Time, double>> factors;  // of the computer
  std::vector<stack::StackEvent> events;
  std::string digest, events_digest;

  std::vector<stack::Measurement> Of(stack::SensorId id) const {
    std::vector<stack::Measurement> all;
    for (const auto& step : given) {
      for (const stack::Measurement& m : step) {
        if (m.sensor == id) all.push_back(m);
      }
    }
    return all;
  }
};

inline constexpr stack::SensorId kImu{1}, kBarometer{2}, kPositionReference{3}, kBattery{4}, kStatus{5},
    kMagnetometer{6}, kGnss{7};

class RigAutopilot : public vehicles::Autopilot {
 public:
  explicit RigAutopilot(FaultyFlight& flight) : flight_(flight) {}
  void Receive(base::Time now, const stack::Command& c) override { flight_.commands.emplace_back(now, c.issued); }
  void Receive(base::Time now, const stack::Estimate& e) override { flight_.estimates.emplace_back(now, e.stamp); }
  vehicles::AutopilotOutput Step(base::Time, const vehicles::AutopilotSensors& sensors) override {
    flight_.sensors.push_back(sensors);
    return {};
  }

 private:
  FaultyFlight& flight_;
};

/// Answers with a command and an estimate every 10 ms; has latencies, or none.
class RigStack : public stack::NavigationStack {
 public:
  RigStack(FaultyFlight& flight, bool declares) : flight_(flight), declares_(declares) {}
  stack::StackOutput Step(base::Time now, std::span<const stack::Measurement> measurements) override {
    now_ = now;
    flight_.given.emplace_back(measurements.begin(), measurements.end());
    stack::StackOutput output;
    if (now.ns % 10'000'000 != 0) return output;
    output.commands.push_back({stack::Hold{}, now, now + base::Milliseconds(100)});
    output.estimate = stack::Estimate{.stamp = now, .X_OB = {}, .X_MO = {}};
    return output;
  }
  bool SetComputeFactor(double factor) override {
    flight_.factors.emplace_back(now_, factor);
    return declares_;
  }

 private:
  FaultyFlight& flight_;
  bool declares_;
  base::Time now_;
};

class RigWatcher : public Observer {
 public:
  explicit RigWatcher(FaultyFlight& flight) : flight_(flight) {}
  std::optional<std::string> Observe(const StepView& step) override {
    digest_.Add(step);
    flight_.events.insert(flight_.events.end(), step.fault_events.begin(), step.fault_events.end());
    flight_.digest = digest_.Hex();
    flight_.events_digest = digest_[Stream::kEvents].Hex();
    return std::nullopt;
  }

 private:
  FaultyFlight& flight_;
  RunDigest digest_;
};

struct RigChoices {
  std::uint64_t seed = 1;
  bool stack_declares = true;
  int steps = 600;
};

inline FaultyFlight Fly(const std::string& faults, const RigChoices& choices = {}) {
  FaultyFlight flight;
  RigWatcher watcher(flight);
  SimulationParts parts;
  parts.world = std::make_shared<const worlds::World>(GroundAndCrate());
  parts.vehicle = std::make_unique<FragileVehicle>(flight.impairments);
  parts.autopilot = std::make_unique<RigAutopilot>(flight);
  parts.stack = std::make_unique<RigStack>(flight, choices.stack_declares);
  parts.sensors.position_reference = PositionReferenceConfig{};
  parts.sensors.magnetometer = MagnetometerConfig{};
  parts.sensors.gnss = GnssReceiverConfig{};
  parts.observers = {&watcher};
  parts.seed = choices.seed;
  parts.faults = Read(faults);
  Simulation simulation(std::move(parts));
  for (int i = 0; i < choices.steps; ++i) simulation.Step();
  return flight;
}

}  // namespace alula::sim::testing
