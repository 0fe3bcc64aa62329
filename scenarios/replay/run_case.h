#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/runner.h"
#include "scenarios/scenario.h"
#include "sim/interval_digests.h"

namespace alula::scenarios::replay {

/// What is known of a run from when it was flown.
struct Recorded {
  std::string digest;                // 16 hexadecimal digits; empty where it is not known
  std::string numeric_class;         // may be empty
  std::vector<sim::DigestRow> rows;  // every scenario.config.recorder.digest_interval; empty where not kept
};

/// A run that can be flown again. Of the options `out`, `spectators` and `interval_digest` are not used.
struct RunCase {
  Scenario scenario;
  RunOptions options;
  std::optional<Recorded> recorded;
};

/// The run that a folder holds: scenario.yaml, verdict.json and, where it has one, digests.csv. Throws
/// base::InputError.
RunCase CaseOfFolder(const std::filesystem::path& folder, RunOptions options);

}  // namespace alula::scenarios::replay
