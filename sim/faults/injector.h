#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "sim/faults/battery.h"
#include "sim/faults/bias.h"
#include "sim/faults/computer.h"
#include "sim/faults/delay.h"
#include "sim/faults/drop.h"
#include "sim/faults/freeze.h"
#include "sim/faults/lens.h"
#include "sim/faults/link.h"
#include "sim/faults/motor.h"
#include "sim/faults/spike.h"
#include "stack/interface/navigation_stack.h"

namespace alula::sim::faults {

/// All kinds of faults: the one list of them. Each brings its word, its keys (Describe) and what it does (Make).
using Config = std::variant<Drop, Freeze, Delay, Bias, Spike, Lens, Motor, Battery, Computer, Link>;

/// A scenario's key `faults`.
void DescribeFaults(base::Description& d, std::vector<Config>& faults);

/// Lets a scenario's faults begin and end, and act.
class Injector {
 public:
  /// Throws base::InputError, with the place in the file, for faults of what is not there, two of one name, and
  /// conditions that can never hold.
  Injector(const std::vector<Config>& configs, const Scope& scope, std::uint64_t seed);

  /// Begins and ends what is due, once a step. True where Impairments may have changed.
  bool Advance(const Situation& situation);
  const Impairments& impairments() const { return impairments_; }
  /// What began and ended in the last Advance, as "fault_begin" and "fault_end".
  std::span<const stack::StackEvent> events() const { return events_; }
  /// Something else to say in this step.
  void Say(base::Time now, std::string kind, std::string text);

  /// A measurement just taken: lost (false), or changed by the faults that last, which are noted in `struck_by`.
  bool Take(stack::Measurement& measurement, Numbers& struck_by);
  /// The measurement on its arrival, its data complete. Measurements of one sensor come in the order of arrival.
  void Arrive(stack::Measurement& measurement, const Numbers& struck_by);

 private:
  struct Entry {
    std::string name;
    Onset onset;
    std::unique_ptr<Fault> fault;
    bool lasts = false;
  };
  std::vector<Entry> entries_;  // in the scenario's order
  Impairments impairments_;
  std::vector<stack::StackEvent> events_;
};

}  // namespace alula::sim::faults
