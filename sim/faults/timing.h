#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "sim/faults/fault.h"

namespace alula::sim::faults {

/// The truth, and how far the mission is, at one instant.
struct Situation {
  base::Time now{};
  double height = 0.0;                                                      // of the body origin above the pad, m
  double speed = 0.0;                                                       // m/s
  double target_distance = 0.0;                                             // m
  int gates_passed = 0;                                                     // in order and forward
  stack::VehicleStatus::Mode mode = stack::VehicleStatus::Mode::kDisarmed;  // the autopilot's
};

/// Holds where everything holds that it states.
struct Condition {
  std::optional<double> height_above{}, height_below{};  // m
  std::optional<double> speed_above{}, speed_below{};    // m/s
  std::optional<double> target_within{};                 // m
  std::optional<int> gates_passed{};                     // at least
  std::optional<stack::VehicleStatus::Mode> mode{};
  base::Origin gates_origin{}, mode_origin{};
};
void Describe(base::Description& d, Condition& c);

bool Holds(const Condition& condition, const Situation& situation);

/// When a fault lasts; part of every kind. It begins at a time, or when a condition comes to hold, or at random: with
/// `rate`, the time without it is exponential with mean 1/rate (a Poisson process while it does not last).
struct Timing {
  std::string name{};  // of the fault, in events and random streams; none: its type and number ("drop 0")
  std::optional<base::Duration> at{};
  std::optional<Condition> when{};
  std::optional<double> rate{};              // 1/s
  std::optional<base::Duration> duration{};  // none: to the end of the run
  std::optional<base::Duration> every{};     // with `at`: from one begin to the next
  std::optional<int> times{};  // at most; none: once with `at` or `when`, without end with `every` or `rate`
  base::Origin name_origin{};
};
/// The keys of Timing, for the Describe of each kind.
void DescribeTiming(base::Description& d, Timing& c);

/// Throws base::InputError for a condition that can never hold here (a gate that is not there).
void CheckTiming(const Timing& timing, const Scope& scope);

/// Follows one fault's timing through a run.
class Onset {
 public:
  /// `name`: of the fault; "faults/<name>/onset" is its stream.
  Onset(const Timing& timing, std::uint64_t seed, const std::string& name);
  /// Whether the fault lasts at `situation.now`; asked once a step.
  bool Lasts(const Situation& situation);

 private:
  /// When it begins if it begins now.
  std::optional<base::Time> Begin(const Situation& situation, bool rises) const;
  base::Duration Gap();

  Timing timing_;
  base::RandomStream stream_;
  std::optional<base::Time> next_;  // of `at` and `rate`
  std::optional<base::Time> until_;
  bool lasts_ = false;
  bool held_ = false;  // the condition, a step ago
  std::int64_t left_;  // begins that are left
};

}  // namespace alula::sim::faults
