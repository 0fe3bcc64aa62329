#pragma once

#include <memory>
#include <string>

#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// A slow computer under the stack: everything takes longer than declared.
struct Computer : Timing {
  static constexpr std::string_view kType = "computer";
  double factor = 5.0;  // on declared latencies
  base::Origin origin{};
};
void Describe(base::Description& d, Computer& c);
std::unique_ptr<Fault> Make(const Computer& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
