#pragma once

#include <string>
#include <vector>

#include "base/describe.h"
#include "sim/faults/fault.h"

namespace alula::sim::faults {

/// The sensors that a fault acts on, by name; `*` stands for any letters: "camera.left", "camera.*", "autopilot.imu".
struct SensorChoice {
  std::string pattern;
  base::Origin origin{};
};
/// The key `sensor`.
void DescribeSensors(base::Description& d, SensorChoice& c);

/// Throws base::InputError where no sensor of the scope has such a name.
std::vector<Sensor> Choose(const SensorChoice& choice, const Scope& scope);

/// Whether the sensor is one of them.
bool Contains(const std::vector<Sensor>& sensors, stack::SensorId id);

/// Their names: "camera.left, camera.right".
std::string NamesOf(const std::vector<Sensor>& sensors);

/// A text matches a pattern in which `*` stands for any letters.
bool Matches(std::string_view pattern, std::string_view text);

}  // namespace alula::sim::faults
