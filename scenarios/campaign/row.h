#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "base/config.h"
#include "scenarios/verdict.h"

namespace alula::scenarios::campaign {

/// One run of a sweep as the database keeps it: its verdict, and what else is known.
struct Row {
  Verdict verdict;                                // versions and digests of streams are not kept
  std::map<std::string, base::Drawn> parameters;  // what varies, by key
  std::string scenario_yaml;                      // resolved: it flies again by itself
  std::string interval_digests;                   // digests.csv of its folder; empty where it died too early
  std::string program;                            // which build flew it
  double wall_s = 0.0;
  double cpu_s = 0.0;           // of all its threads
  double peak_memory_mb = 0.0;  // resident
};

/// What stands where a table wants one word on why a run did not pass: of a fault its reason, of a failure the checks
/// that failed. Empty for a pass.
std::string FailureOf(const Verdict& verdict);

}  // namespace alula::scenarios::campaign
