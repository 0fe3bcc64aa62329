#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "scenarios/campaign/case.h"
#include "scenarios/campaign/database.h"
#include "scenarios/campaign/executor.h"
#include "scenarios/campaign/sweep.h"

namespace alula::scenarios::campaign::internal {

/// Flies what a database does not yet hold of a plan, or of a shard of it. What it was made from outlives it.
class SweepFlight {
 public:
  SweepFlight(const SweepRequest& request, const CaseMaker& cases, Database& database, const Shard& shard);

  /// Flies runs `first` … `end` − 1 of the plan; `points`, one a run, take the place of the plan's order. True where
  /// Ctrl-C ended it.
  bool Fly(const std::filesystem::path& work, std::size_t first, std::size_t end,
           const std::vector<std::vector<double>>* points = nullptr);
  /// The whole plan.
  bool FlyAll(const std::filesystem::path& work) { return Fly(work, 0, rows_.size()); }

  const std::optional<Row>& row(std::size_t index) const { return rows_[index]; }
  /// Takes the rows with it.
  SweepResult Result();

 private:
  void TakeWhatIsThere();
  void Count(const Row& row);
  void StartOrAdopt(std::size_t index, const std::vector<double>* point, Executor& executor);
  void Keep(std::size_t index, Row row, const Executor& executor);
  bool Enough();
  double Seconds() const;
  void Tell(const Row* row) const;

  const SweepRequest& request_;
  const CaseMaker& cases_;
  Database& database_;
  Shard shard_;
  std::vector<std::optional<Row>> rows_;  // by index in the plan
  std::vector<const Row*> prefix_;        // of rows_, from the first on without a gap
  std::vector<SweepResult::Decided> decided_;
  std::size_t planned_ = 0, done_ = 0, flown_ = 0;
  std::size_t outcomes_[3] = {};  // by Outcome
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace alula::scenarios::campaign::internal
