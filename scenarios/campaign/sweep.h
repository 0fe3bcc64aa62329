#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/campaign/case.h"
#include "scenarios/campaign/database.h"
#include "scenarios/campaign/executor.h"
#include "scenarios/campaign/statistics/requirement.h"
#include "scenarios/campaign/statistics/sequential_test.h"

namespace alula::scenarios::campaign {

/// What stands at the end of `alula sweep`, of the runs that its plan names.
struct SweepResult {
  std::string scenario;
  std::filesystem::path database;
  std::vector<Row> rows;    // by index in the plan; of an unfinished sweep those that there are
  std::size_t planned = 0;  // runs
  std::size_t flown = 0;    // by this call; the others were there
  struct Decided {
    statistics::Requirement requirement;
    statistics::Decision decision = statistics::Decision::kUndecided;
    std::size_t runs = 0;  // after which it was decided, in the plan's order
    std::int64_t successes = 0;
    statistics::Interval interval;  // valid whenever one stops
  };
  std::vector<Decided> requirements;
  bool interrupted = false;
  std::string note;  // what a person should know about the sample
  int jobs = 1;
  double wall_s = 0.0;  // of this call

  bool StoppedEarly() const { return !requirements.empty() && rows.size() < planned && !interrupted; }
};

/// What a sweep tells while it goes on.
struct SweepNews {
  std::size_t done = 0, planned = 0;
  std::size_t passes = 0, failures = 0, faults = 0;
  double seconds = 0.0;      // since this call began
  std::size_t flown = 0;     // by it
  const Row* row = nullptr;  // the run that ended; null where only time has passed
};

struct SweepRequest {
  SweepPlan plan;
  std::filesystem::path out;
  bool fresh = false;
  std::vector<statistics::Requirement> requirements;
  ExecutorOptions executor;  // its folders and name follow from the plan and `out`
  std::function<void(const SweepNews&)> news;
};

/// One shard of a sweep that several processes share.
struct Shard {
  int number = 0;
  int of = 1;
  std::function<bool()> still_ours;  // asked before each row is written

  bool Has(std::size_t index) const { return index % static_cast<std::size_t>(of) == static_cast<std::size_t>(number); }
};

/// Flies what the database does not yet hold, until all is flown or all requirements are decided. Killed at any moment,
/// the same call goes on where it was: a run is in the database, or its finished folder is taken over, or it is flown.
SweepResult RunSweep(const SweepRequest& request);

/// Flies the cases of one shard into `file`, under `request.out`, which others share: no lock is taken here.
SweepResult RunShard(const SweepRequest& request, const Shard& shard, const std::filesystem::path& file);

/// The result as far as the database holds it.
SweepResult ResultOf(const SweepRequest& request, const CaseMaker& cases, Database& database);

/// Requirements are looked at in the plan's order, not in that of ending: failures may end sooner than passes.
std::vector<SweepResult::Decided> Decide(const std::vector<statistics::Requirement>& requirements,
                                         const std::vector<const Row*>& in_order);

/// 0, 1, 3 of a sweep without requirements: all passed, one failed, one was a fault; with them 0, 1 or 4.
int ExitCode(const SweepResult& result);

}  // namespace alula::scenarios::campaign
