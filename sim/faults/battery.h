#pragma once

#include <memory>
#include <string>

#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// A pack that collapses: a cell shorted, cold, or worn out.
struct Battery : Timing {
  static constexpr std::string_view kType = "battery";
  double resistance = 1.0;  // factor on its internal resistance
  double voltage = 1.0;     // share of its open-circuit voltage that is left
  base::Origin origin{};    // of what was given
};
void Describe(base::Description& d, Battery& c);
std::unique_ptr<Fault> Make(const Battery& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
