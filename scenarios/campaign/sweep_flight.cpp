#include "scenarios/campaign/internal/sweep_flight.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/error.h"
#include "scenarios/campaign/same_sweep.h"

namespace alula::scenarios::campaign::internal {

SweepFlight::SweepFlight(const SweepRequest& request, const CaseMaker& cases, Database& database, const Shard& shard)
    : request_(request),
      cases_(cases),
      database_(database),
      shard_(shard),
      rows_(request.plan.seeds.size()),
      begin_(std::chrono::steady_clock::now()) {
  for (std::size_t i = 0; i < rows_.size(); ++i) planned_ += shard_.Has(i);
  TakeWhatIsThere();
}

void SweepFlight::TakeWhatIsThere() {
  std::map<std::uint64_t, std::size_t> index_of;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (shard_.Has(i)) index_of[request_.plan.seeds[i]] = i;
  }
  for (Row& row : database_.Rows()) {
    const auto found = index_of.find(row.verdict.seed);
    if (found == index_of.end()) continue;
    rows_[found->second] = std::move(row);
    Count(*rows_[found->second]);
  }
}

bool SweepFlight::Fly(const std::filesystem::path& work, std::size_t first, std::size_t end,
                      const std::vector<std::vector<double>>* points) {
  ExecutorOptions options = request_.executor;
  options.folder = request_.out;
  options.work = work;
  options.name = cases_.name();
  Executor executor(options);
  std::size_t next = first;
  Tell(nullptr);
  while (!Enough() && !executor.Interrupted()) {
    while (!executor.Full() && next < end && !Enough()) {
      StartOrAdopt(next, points == nullptr ? nullptr : &(*points)[next - first], executor);
      ++next;
    }
    if (executor.Idle() && next >= end) break;
    constexpr std::chrono::milliseconds kRedraw(500);
    if (std::optional<Executor::Finished> finished = executor.Wait(kRedraw)) {
      ++flown_;
      Keep(finished->index, std::move(finished->row), executor);
    } else {
      Tell(nullptr);
    }
  }
  return executor.Interrupted();
}

void SweepFlight::StartOrAdopt(std::size_t index, const std::vector<double>* point, Executor& executor) {
  if (!shard_.Has(index)) return;
  if (rows_[index]) {
    if (point != nullptr) CheckSameCase(database_, cases_.Make(index, point));
    executor.Settle(*rows_[index]);  // killed after the row was written, its folder may still be there
    return;
  }
  Case next = cases_.Make(index, point);
  if (std::optional<Row> row = executor.Adopt(next)) {
    Keep(index, std::move(*row), executor);
  } else {
    executor.Start(std::move(next));
  }
}

void SweepFlight::Keep(std::size_t index, Row row, const Executor& executor) {
  if (shard_.still_ours && !shard_.still_ours()) {
    throw base::FaultError("claim", "another process has taken shard " + std::to_string(shard_.number) + " over");
  }
  database_.Insert(row);
  executor.Settle(row);
  row.scenario_yaml.clear();  // the database has them
  row.interval_digests.clear();
  rows_[index] = std::move(row);
  Count(*rows_[index]);
  Tell(&*rows_[index]);
}

void SweepFlight::Count(const Row& row) {
  ++done_;
  ++outcomes_[static_cast<std::size_t>(row.verdict.outcome)];
}

/// Whether all requirements are decided by the runs from the first one on without a gap.
bool SweepFlight::Enough() {
  if (request_.requirements.empty()) return false;
  const std::size_t before = prefix_.size();
  while (prefix_.size() < rows_.size() && rows_[prefix_.size()]) prefix_.push_back(&*rows_[prefix_.size()]);
  if (prefix_.size() != before || decided_.empty()) decided_ = Decide(request_.requirements, prefix_);
  return std::all_of(decided_.begin(), decided_.end(),
                     [](const SweepResult::Decided& d) { return d.decision != statistics::Decision::kUndecided; });
}

double SweepFlight::Seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void SweepFlight::Tell(const Row* row) const {
  if (!request_.news) return;
  request_.news({done_, planned_, outcomes_[0], outcomes_[1], outcomes_[2], Seconds(), flown_, row});
}

SweepResult SweepFlight::Result() {
  Enough();
  SweepResult result;
  result.scenario = cases_.name();
  result.database = database_.file();
  result.planned = planned_;
  result.flown = flown_;
  result.requirements = decided_;
  result.jobs = request_.executor.jobs;
  result.wall_s = Seconds();
  if (cases_.distributions().empty() && request_.plan.Variants() == 1) {
    result.note = "no key of the scenario is a distribution: runs differ by their seeds alone";
  }
  for (std::optional<Row>& row : rows_) {
    if (row) result.rows.push_back(std::move(*row));
  }
  return result;
}

}  // namespace alula::scenarios::campaign::internal
