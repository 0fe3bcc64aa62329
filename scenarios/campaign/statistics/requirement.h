#pragma once

#include <optional>
#include <string>

#include "scenarios/campaign/statistics/sequential_test.h"

namespace alula::scenarios::statistics {

struct MetricBound {
  std::string name;
  bool at_most = true;
  double limit = 0.0;
};

/// What `--require` asks for: a rate of passes, or of runs in which a metric keeps a bound.
struct Requirement {
  std::string text;
  std::optional<MetricBound> metric;
  RateRequirement rate;
};

/// "success >= 0.95 @ 95%" or "P(ate_online_m <= 0.1) >= 0.9 @ 95%". Throws base::InputError.
Requirement ParseRequirement(const std::string& text);

}  // namespace alula::scenarios::statistics
