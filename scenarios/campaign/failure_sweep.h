#pragma once

#include <string>
#include <vector>

#include "scenarios/campaign/search/failure_search.h"
#include "scenarios/campaign/sweep.h"

namespace alula::scenarios::campaign {

/// What `--search failures` came to.
struct FailureSweepResult {
  SweepResult sweep;
  search::FailureEstimate estimate;
  struct Range {
    std::string path;
    std::string low, middle, high;  // values one standard deviation about the middle
  };
  struct Region {
    double share = 0.0;  // of the probability
    std::vector<Range> parameters;
  };
  std::vector<Region> regions;
};

/// Looks for rare failures among the distributions of the scenario (search/failure_search.h); the plan's seeds are the
/// runs allowed. Called again, it takes the same way through the runs that are there.
FailureSweepResult SearchFailures(const SweepRequest& request, search::FailureSearchConfig config);

/// How far a run was from failing: the least room that a check had, as a share of its limit (of limits of 0 in the
/// check's unit); 0 or less for a failed check, −∞ for a fault.
double MarginOf(const Verdict& verdict);

}  // namespace alula::scenarios::campaign
