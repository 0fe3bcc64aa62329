#pragma once

#include <memory>
#include <string>

#include "sim/faults/offsets.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// Single readings that are far off, to either side.
struct Spike : Timing {
  static constexpr std::string_view kType = "spike";
  SensorChoice sensor;
  Offsets offset;
  double share = 0.1;  // of the readings, each by itself; half of them with the other sign
};
void Describe(base::Description& d, Spike& c);
std::unique_ptr<Fault> Make(const Spike& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
