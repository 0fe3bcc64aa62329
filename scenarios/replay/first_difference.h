#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/replay/config_difference.h"
#include "scenarios/replay/difference.h"
#include "scenarios/replay/run_case.h"

namespace alula::scenarios::replay {

/// What sets two runs apart.
struct RunComparison {
  std::vector<ConfigDifference> config;  // keys of their scenarios
  std::vector<std::string> notes;        // a line each: a run that, flown again, is not the one recorded
  std::optional<Difference> first;       // none: the runs are the same
};

/// The first difference of two runs:
///
///   1. the digests of both say whether and in which interval they part (from what was recorded, else by flying A)
///   2. B is flown against A's digests until one differs, A again to the end of that interval
///   3. the records of that interval are compared one by one, in the order of the loop
///
/// Runs with equal recorded digests are not flown at all. Memory: the records of one interval of both runs, and a row
/// of digests an interval. Stacks fly in this process, one run after the other. Throws base::InputError, Interrupted,
/// and base::FaultError ("not_deterministic") for a run that does not repeat itself.
RunComparison CompareRuns(const RunCase& a, const RunCase& b);

/// For a person: keys that differ, notes, then one line: "first difference at 5.000 s (step 5000): commands:
/// position_setpoint.p_OB.z: 1.5 in A, 1.51 in B".
std::string ToText(const RunComparison& comparison);
/// {"same", "config": [{path, a, b}], "notes": […], "first": null or {time_s, step, stream, record, field, a, b,
/// note}}.
std::string ToJson(const RunComparison& comparison);

}  // namespace alula::scenarios::replay
