#pragma once

#include <memory>
#include <string>

#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// A motor that gives less than it should: magnets, bearing, speed controller; 0: it stops.
struct Motor : Timing {
  static constexpr std::string_view kType = "motor";
  int motor = 0;          // in the order of the motor commands
  double thrust = 0.0;    // share that is left
  base::Origin origin{};  // of `motor`
};
void Describe(base::Description& d, Motor& c);
std::unique_ptr<Fault> Make(const Motor& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
