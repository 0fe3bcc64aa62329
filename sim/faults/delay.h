#pragma once

#include <memory>
#include <string>

#include "sim/faults/sensor_choice.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// Measurements that arrive later than they should, with the stamps that they should have.
struct Delay : Timing {
  static constexpr std::string_view kType = "delay";
  SensorChoice sensor;
  base::Duration by = base::Milliseconds(100);
};
void Describe(base::Description& d, Delay& c);
std::unique_ptr<Fault> Make(const Delay& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
