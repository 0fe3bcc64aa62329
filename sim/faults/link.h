#pragma once

#include <memory>
#include <string>

#include "sim/faults/timing.h"

namespace alula::sim::faults {

/// The link between stack and autopilot is lost. What is on its way still arrives.
struct Link : Timing {
  enum class Direction : std::uint8_t {
    kUp,    // commands and estimates do not reach the autopilot
    kDown,  // its reports do not reach the stack
    kBoth,
  };
  static constexpr std::string_view kType = "link";
  Direction direction = Direction::kBoth;
  base::Origin origin{};  // of `direction`
};
void Describe(base::Description& d, Link& c);
std::unique_ptr<Fault> Make(const Link& config, const Scope& scope, std::uint64_t seed, const std::string& name);

}  // namespace alula::sim::faults
