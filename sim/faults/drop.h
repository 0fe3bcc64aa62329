#pragma once

#include <memory>
#include <string>

#include "sim/faults/sensor_choice.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// Measurements that never arrive: a cable, a driver, a busy bus.
struct Drop : Timing {
  static constexpr std::string_view kType = "drop";
  SensorChoice sensor;
  double share = 1.0;  // of them
};
void Describe(base::Description& d, Drop& c);
std::unique_ptr<Fault> Make(const Drop& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
