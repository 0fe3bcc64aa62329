#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "render/sensor_effects.h"
#include "stack/interface/measurement.h"
#include "vehicles/vehicle.h"

/// What goes wrong in a flight, on purpose. README.md says how a new kind is added.
namespace alula::sim::faults {

/// A sensor that a fault may name. Its sample is an empty one of its kind: it says what can be shifted.
struct Sensor {
  std::string name;  // without the vehicle's: "imu", "camera.left", "autopilot.barometer"
  stack::SensorId id{};
  decltype(stack::Measurement::data) sample;
};

/// What one scenario has that may break.
struct Scope {
  std::vector<Sensor> sensors;
  int motors = 0;
  int gates = 0;
  bool autopilot = false;
  bool stack = false;
};

/// What all faults that last at the moment do, together, to everything but measurements.
struct Impairments {
  vehicles::Impairment vehicle;
  double computer = 1.0;                         // factor on the latencies that the stack declares
  bool commands_lost = false;                    // what the stack sends does not reach the autopilot
  std::map<stack::SensorId, render::Dirt> dirt;  // on lenses, besides what the camera has anyway
};

/// A fault as it acts; when it lasts is not its business (timing.h).
class Fault {
 public:
  virtual ~Fault() = default;
  /// For events: "camera.left: every measurement is lost".
  virtual std::string Words() const = 0;
  /// Adds what it does for as long as it lasts.
  virtual void Impair(Impairments&) const {}
  /// The measurements that it acts on.
  virtual bool Concerns(stack::SensorId) const { return false; }
  /// A measurement that a sensor took while the fault lasts (an image has no pixels yet). False: it is lost.
  virtual bool Take(stack::Measurement&) { return true; }
  /// A measurement on its arrival. `struck`: it was taken while the fault lasted.
  virtual void Arrive(stack::Measurement&, bool /*struck*/) {}
};

/// Numbers (in the scenario's list) of the faults that lasted when a measurement was taken.
using Numbers = std::vector<std::uint16_t>;

}  // namespace alula::sim::faults
