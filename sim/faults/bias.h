#pragma once

#include <memory>
#include <string>

#include "sim/faults/offsets.h"
#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// Readings that are off by a constant.
struct Bias : Timing {
  static constexpr std::string_view kType = "bias";
  SensorChoice sensor;
  Offsets offset;
};
void Describe(base::Description& d, Bias& c);
std::unique_ptr<Fault> Make(const Bias& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
