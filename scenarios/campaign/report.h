#pragma once

#include <string>
#include <vector>

#include "scenarios/campaign/failure_sweep.h"
#include "scenarios/campaign/sweep.h"
#include "scenarios/junit.h"

namespace alula::scenarios::campaign {

/// Runs that failed in one way.
struct FailureGroup {
  std::string failure;  // row.h: FailureOf
  bool fault = false;
  std::string message;  // of the first one
  std::vector<std::uint64_t> seeds;
};
/// The largest first.
std::vector<FailureGroup> GroupFailures(const std::vector<Row>& rows);

/// The result as a person reads it: success with its interval, requirements, failures by kind and by the parameters
/// that separate them, quantiles of the metrics with bootstrap intervals.
std::string ToTable(const SweepResult& result);
/// "courtyard_gates: 39 of 40 pass (97.5 %, …)".
std::string LastLine(const SweepResult& result);
std::string ToJson(const SweepResult& result);
/// Of a search for failures.
std::string ToTable(const FailureSweepResult& result);
std::string LastLine(const FailureSweepResult& result);
std::string ToJson(const FailureSweepResult& result);
/// A test case a run, and one for each requirement.
std::vector<JunitCase> JunitCases(const SweepResult& result);

/// "1-3, 7".
std::string SeedsText(std::vector<std::uint64_t> seeds);

}  // namespace alula::scenarios::campaign
