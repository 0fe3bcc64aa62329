#include "scenarios/campaign/sweep.h"

#include <algorithm>
#include <utility>

#include "scenarios/campaign/internal/sweep_flight.h"
#include "scenarios/campaign/same_sweep.h"
#include "scenarios/campaign/sweep_folder.h"
#include "scenarios/exit_codes.h"

namespace alula::scenarios::campaign {
namespace fs = std::filesystem;
namespace {

using statistics::Decision;

bool Holds(const statistics::Requirement& requirement, const Row& row) {
  if (!requirement.metric) return row.verdict.outcome == Outcome::kPass;
  const auto found = row.verdict.metrics.find(requirement.metric->name);
  return found != row.verdict.metrics.end() && requirement.metric->Holds(found->second);  // a crash measures nothing
}

}  // namespace

SweepResult RunSweep(const SweepRequest& request) {
  const CaseMaker cases(request.plan);
  const SweepFolder folder(request.out, request.fresh);
  Database database(folder.path() / "sweep.db", Database::Mode::kWrite);
  CheckSameSweep(database, cases);
  internal::SweepFlight sweep(request, cases, database, {});
  const bool interrupted = sweep.FlyAll(folder.path() / ".work");
  SweepResult result = sweep.Result();
  result.interrupted = interrupted;
  return result;
}

SweepResult RunShard(const SweepRequest& request, const Shard& shard, const fs::path& file) {
  const CaseMaker cases(request.plan);
  Database database(file, Database::Mode::kWrite);
  CheckSameSweep(database, cases);
  internal::SweepFlight sweep(request, cases, database, shard);
  const bool interrupted = sweep.FlyAll(file.string() + ".work");
  SweepResult result = sweep.Result();
  result.interrupted = interrupted;
  return result;
}

SweepResult ResultOf(const SweepRequest& request, const CaseMaker& cases, Database& database) {
  return internal::SweepFlight(request, cases, database, {}).Result();
}

std::vector<SweepResult::Decided> Decide(const std::vector<statistics::Requirement>& requirements,
                                         const std::vector<const Row*>& in_order) {
  std::vector<SweepResult::Decided> all;
  for (const statistics::Requirement& requirement : requirements) {
    SweepResult::Decided decided;
    decided.requirement = requirement;
    statistics::SequentialTest test(requirement.rate);
    for (const Row* row : in_order) {
      const bool success = Holds(requirement, *row);
      decided.decision = test.Add(success);
      ++decided.runs;
      decided.successes += success;
      if (decided.decision != Decision::kUndecided) break;
    }
    decided.interval = test.interval();
    all.push_back(std::move(decided));
  }
  return all;
}

int ExitCode(const SweepResult& result) {
  if (result.interrupted) return kExitInterrupted;
  int code = kExitPassed;
  if (!result.requirements.empty()) {
    for (const SweepResult::Decided& decided : result.requirements) {
      if (decided.decision == Decision::kRejected) return kExitFailed;
      if (decided.decision == Decision::kUndecided) code = kExitUndecided;
    }
    return code;
  }
  for (const Row& row : result.rows) code = std::max(code, scenarios::ExitCode(row.verdict.outcome));
  return code;
}

}  // namespace alula::scenarios::campaign
