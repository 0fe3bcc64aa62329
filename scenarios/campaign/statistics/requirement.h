#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenarios/campaign/statistics/sequential_test.h"

namespace alula::scenarios::statistics {

/// A limit on one metric of a run, in the metric's own unit ("ate_online_m <= 0.5").
struct MetricBound {
  std::string name;
  bool at_most = true;  // else at least
  double limit = 0.0;

  /// A value that is not a number does not.
  bool Holds(double value) const { return at_most ? value <= limit : value >= limit; }
};

/// What a sweep has to show, as it was written.
struct Requirement {
  std::string text;
  std::optional<MetricBound> metric;  // none: the run's own verdict
  RateRequirement rate;
};

/// Reads one `--require`:
///
///   success >= 0.95 @ 95%
///   P(ate_online_m <= 0.5) >= 0.95 @ 95%        (>= inside the parentheses too)
///
/// Rate and confidence are written as 0.95 or 95%; blanks are free. InputError, one line that says which part is wrong
/// and how both forms look, for anything else: a rate outside (0, 1), a confidence outside [50 %, 100 %), text behind
/// the end, an unknown subject. Whether a metric of that name exists is the caller's to check, and a run without the
/// metric (it crashed) is a failed one.
Requirement ParseRequirement(std::string_view text);

}  // namespace alula::scenarios::statistics
