#include "scenarios/campaign/sweep.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "scenarios/exit_codes.h"

namespace alula::scenarios::campaign {
namespace fs = std::filesystem;
namespace {

using statistics::Decision;

bool Holds(const statistics::Requirement& requirement, const Row& row) {
  if (!requirement.metric) return row.verdict.outcome == Outcome::kPass;
  const auto found = row.verdict.metrics.find(requirement.metric->name);
  if (found == row.verdict.metrics.end()) return false;  // never measured, as in a run that crashed
  return requirement.metric->at_most ? found->second <= requirement.metric->limit
                                     : found->second >= requirement.metric->limit;
}

/// Where two texts part: the lines of both.
std::string FirstOtherLine(const std::string& before, const std::string& now) {
  const auto [a, b] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
  const auto line = [](const std::string& text, std::string::const_iterator at) -> std::string {
    if (at == text.end()) return "nothing";
    const std::size_t position = static_cast<std::size_t>(at - text.begin());
    const std::size_t newline = text.rfind('\n', position == 0 ? 0 : position - 1);
    const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
    const std::size_t first = text.find_first_not_of(' ', begin);
    return "`" + text.substr(first, text.find('\n', first) - first) + "`";
  };
  return line(before, a) + " before, " + line(now, b) + " now";
}

std::string FolderOf(const Database& database) { return database.file().parent_path().string(); }

constexpr const char* kMend = "name another --out, or begin again with --fresh";

/// Throws base::InputError where another build flew what is there.
void CheckSameProgram(Database& database, const std::string& scenario) {
  if (database.Seeds().empty()) {
    database.SetFact("program", ProgramHash());
    database.SetFact("scenario", scenario);
  } else if (database.Fact("program") != ProgramHash()) {
    throw base::InputError(FolderOf(database) +
                           ": holds runs of another build of Alula, which would not be one sample with new ones; " +
                           kMend);
  }
}

/// Throws base::InputError where the run that is there was another one than would be flown now.
void CheckSameCase(const Database& database, const Case& now) {
  const std::optional<Row> then = database.Find(now.seed);
  if (then->scenario_yaml == now.scenario_yaml) return;
  throw base::InputError(FolderOf(database) + ": holds runs of another scenario or plan (seed " +
                         std::to_string(now.seed) +
                         " would differ: " + FirstOtherLine(then->scenario_yaml, now.scenario_yaml) + "); " + kMend);
}

/// Points of standard normal space as shares of each distribution.
std::vector<std::vector<double>> QuantilesOf(const std::vector<search::Point>& points) {
  std::vector<std::vector<double>> quantiles;
  for (const search::Point& point : points) {
    std::vector<double>& shares = quantiles.emplace_back();
    for (const double z : point) shares.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)));
  }
  return quantiles;
}

/// The parameters in the middle of a region of failures, and a standard deviation to both sides.
FailureSweepResult::Region DescribeRegion(const search::FailureEstimate::Region& region, const CaseMaker& cases) {
  const auto at = [&](double side) {
    const search::Point point = region.mean + side * region.spread;
    return cases.Make(0, &QuantilesOf({point}).front()).parameters;
  };
  const auto low = at(-1.0), middle = at(0.0), high = at(1.0);
  FailureSweepResult::Region described;
  described.share = region.share;
  for (const std::string& path : cases.distributions()) {
    if (!middle.contains(path) || !low.contains(path) || !high.contains(path)) continue;
    described.parameters.push_back({path, low.at(path).value, middle.at(path).value, high.at(path).value});
  }
  return described;
}

/// Flies what a database does not yet hold of a plan, or of a shard of it.
class Sweep {
 public:
  Sweep(const SweepRequest& request, const CaseMaker& cases, Database& database, const Shard& shard)
      : request_(request),
        cases_(cases),
        database_(database),
        shard_(shard),
        rows_(request.plan.seeds.size()),
        begin_(std::chrono::steady_clock::now()) {
    for (std::size_t i = 0; i < rows_.size(); ++i) planned_ += shard_.Has(i);
    TakeWhatIsThere();
  }

  /// Flies runs `first` … `end` − 1 of the plan; `points`, one a run, take the place of the plan's order. True where
  /// Ctrl-C ended it.
  bool Fly(const fs::path& work, std::size_t first, std::size_t end, const std::vector<std::vector<double>>* points) {
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
      std::optional<Executor::Finished> finished = executor.Wait(kRedraw);
      if (finished) {
        ++flown_;
        Keep(finished->index, std::move(finished->row), executor);
      } else {
        Tell(nullptr);
      }
    }
    return executor.Interrupted();
  }

  const std::optional<Row>& row(std::size_t index) const { return rows_[index]; }

  SweepResult Result() {
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

 private:
  void TakeWhatIsThere() {
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

  void Count(const Row& row) {
    ++done_;
    ++outcomes_[static_cast<std::size_t>(row.verdict.outcome)];
  }

  void StartOrAdopt(std::size_t index, const std::vector<double>* point, Executor& executor) {
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

  void Keep(std::size_t index, Row row, const Executor& executor) {
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

  /// Whether all requirements are decided by the runs from the first one on without a gap.
  bool Enough() {
    if (request_.requirements.empty()) return false;
    const std::size_t before = prefix_.size();
    while (prefix_.size() < rows_.size() && rows_[prefix_.size()]) prefix_.push_back(&*rows_[prefix_.size()]);
    if (prefix_.size() != before || decided_.empty()) decided_ = Decide(request_.requirements, prefix_);
    return std::all_of(decided_.begin(), decided_.end(),
                       [](const SweepResult::Decided& d) { return d.decision != Decision::kUndecided; });
  }

  double Seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

  void Tell(const Row* row) const {
    if (!request_.news) return;
    request_.news({done_, planned_, outcomes_[0], outcomes_[1], outcomes_[2], Seconds(), flown_, row});
  }

  const SweepRequest& request_;
  const CaseMaker& cases_;
  Database& database_;
  Shard shard_;
  std::vector<std::optional<Row>> rows_;  // by index in the plan
  std::vector<const Row*> prefix_;
  std::vector<SweepResult::Decided> decided_;
  std::size_t planned_ = 0, done_ = 0, flown_ = 0;
  std::size_t outcomes_[3] = {};  // by Outcome
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace

SweepFolder::SweepFolder(const fs::path& folder, bool fresh) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder_, error);
  const fs::path file = folder_ / "sweep.lock";
  if (!error) lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) {
    const std::string why = error ? error.message() : std::system_category().message(errno);
    throw base::InputError("--out: cannot write to " + folder_.string() + " (" + why +
                           "); name a folder that can be written");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw base::InputError("--out: another sweep is at work in " + folder_.string() +
                           "; wait for it, or name another folder");
  }
  if (fresh) {
    for (const char* name : {"sweep.db", "sweep.db-journal", "runs", ".work", "shards", "slurm", "plan.json"}) {
      fs::remove_all(folder_ / name, error);
    }
  }
}

SweepFolder::~SweepFolder() { ::close(lock_); }

void CheckSameSweep(Database& database, const CaseMaker& cases) {
  const std::set<std::uint64_t> there = database.Seeds();
  CheckSameProgram(database, cases.name());
  constexpr std::size_t kLooks = 5;  // a plan or scenario that changed changes all runs, or nearly all
  std::size_t looks = 0;
  for (std::size_t i = 0; i < cases.plan().seeds.size() && looks < kLooks; ++i) {
    if (!there.contains(cases.plan().seeds[i])) continue;
    ++looks;
    CheckSameCase(database, cases.Make(i));
  }
}

SweepResult RunSweep(const SweepRequest& request) {
  const CaseMaker cases(request.plan);
  const SweepFolder folder(request.out, request.fresh);
  Database database(folder.path() / "sweep.db", Database::Mode::kWrite);
  CheckSameSweep(database, cases);
  Sweep sweep(request, cases, database, {});
  const bool interrupted = sweep.Fly(folder.path() / ".work", 0, request.plan.seeds.size(), nullptr);
  SweepResult result = sweep.Result();
  result.interrupted = interrupted;
  return result;
}

FailureSweepResult SearchFailures(const SweepRequest& request, search::FailureSearchConfig config) {
  const CaseMaker cases(request.plan);
  if (cases.distributions().empty()) {
    throw base::InputError("--search failures: nothing in " + cases.name() +
                           " is a distribution; give one, as --set 'vehicle.mass={normal: [0.75 kg, 0.02 kg]}'");
  }
  const SweepFolder folder(request.out, request.fresh);
  Database database(folder.path() / "sweep.db", Database::Mode::kWrite);
  CheckSameProgram(database, cases.name());
  Sweep sweep(request, cases, database, {});
  config.max_runs = static_cast<std::int64_t>(request.plan.seeds.size());
  search::FailureSearch search(config, cases.distributions().size(), request.plan.seeds.front());
  FailureSweepResult result;
  for (std::size_t first = 0; !search.done() && !result.sweep.interrupted;) {
    const std::vector<std::vector<double>> points = QuantilesOf(search.Ask());
    const std::size_t end = first + points.size();
    if (sweep.Fly(folder.path() / ".work", first, end, &points)) {
      result.sweep.interrupted = true;
      break;
    }
    std::vector<double> margins;
    for (std::size_t i = first; i < end; ++i) margins.push_back(MarginOf(sweep.row(i)->verdict));
    search.Tell(margins);
    first = end;
  }
  result.estimate = search.estimate();
  for (const search::FailureEstimate::Region& region : result.estimate.regions) {
    result.regions.push_back(DescribeRegion(region, cases));
  }
  const bool interrupted = result.sweep.interrupted;
  result.sweep = sweep.Result();
  result.sweep.interrupted = interrupted;
  return result;
}

SweepResult RunShard(const SweepRequest& request, const Shard& shard, const fs::path& file) {
  const CaseMaker cases(request.plan);
  Database database(file, Database::Mode::kWrite);
  CheckSameSweep(database, cases);
  Sweep sweep(request, cases, database, shard);
  const bool interrupted = sweep.Fly(file.string() + ".work", 0, request.plan.seeds.size(), nullptr);
  SweepResult result = sweep.Result();
  result.interrupted = interrupted;
  return result;
}

double MarginOf(const Verdict& verdict) {
  constexpr double kBarely = 1e-9;
  if (verdict.outcome == Outcome::kFault) return -std::numeric_limits<double>::infinity();
  double margin = std::numeric_limits<double>::infinity();
  for (const Check& check : verdict.checks) {
    const bool counts = check.unit == "1" && check.limit == 0.0;  // contacts, faults: they say yes or no
    double room = check.relation.front() == '<' ? check.limit - check.measured : check.measured - check.limit;
    room /= check.limit == 0.0 ? 1.0 : std::abs(check.limit);
    if (!std::isfinite(check.measured)) room = -1.0;
    margin = std::min(margin, check.passed ? (counts ? margin : std::max(kBarely, room)) : std::min(0.0, room));
  }
  return margin;
}

SweepResult ResultOf(const SweepRequest& request, const CaseMaker& cases, Database& database) {
  return Sweep(request, cases, database, {}).Result();
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
