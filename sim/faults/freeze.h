#pragma once

#include <memory>
#include <string>

#include "sim/faults/sensor_choice.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// A sensor that goes on stamping what it measured last: a stuck driver or buffer.
struct Freeze : Timing {
  static constexpr std::string_view kType = "freeze";
  SensorChoice sensor;
};
void Describe(base::Description& d, Freeze& c);
std::unique_ptr<Fault> Make(const Freeze& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
