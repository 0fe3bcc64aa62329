#include "scenarios/campaign/slurm_sweep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "scenarios/campaign/internal/shard_plan.h"
#include "scenarios/campaign/same_sweep.h"
#include "scenarios/campaign/slurm/batch_script.h"
#include "scenarios/campaign/slurm/queue.h"
#include "scenarios/campaign/slurm/resubmission.h"
#include "scenarios/campaign/sweep_folder.h"
#include "scenarios/write_file.h"

namespace alula::scenarios::campaign {
namespace fs = std::filesystem;
namespace {

using internal::ShardFile;
using internal::ShardsOfPlan;

constexpr std::size_t kRunsPerShard = 10;
constexpr double kClaimPatience = 120.0;            // s that a task waits for the one before it to let go of the shard
constexpr std::chrono::milliseconds kGlance(2000);  // between looks at the shards' files
constexpr std::chrono::seconds kBetweenQuestions(10);  // to the queue, which others share
constexpr std::chrono::seconds kFresh(10);             // a file's age below which its time says nothing
using Clock = std::chrono::steady_clock;

slurm::SlurmJob JobOf(const SlurmRequest& request, const fs::path& folder, std::vector<int> shards) {
  const ExecutorOptions& e = request.sweep.executor;
  slurm::SlurmJob job;
  job.folder = folder;
  job.binary = fs::read_symlink("/proc/self/exe");
  job.name = slurm::JobName(folder);
  job.shards = std::move(shards);
  job.cpus_per_task = e.jobs;
  if (e.limits.memory) {
    constexpr double kBeside = 256.0;  // MB for the sweep itself
    job.memory_mb = static_cast<int>(std::ceil(static_cast<double>(*e.limits.memory) * 1e-6 * e.jobs + kBeside));
  }
  job.options = request.options;
  return job;
}

/// The number of shards is fixed when the sweep begins: which runs a shard holds depends on it.
int ShardsOf(const SlurmRequest& request, const fs::path& folder) {
  if (const int there = ShardsOfPlan(folder); there > 0) return there;
  const std::size_t runs = request.sweep.plan.seeds.size();
  constexpr std::size_t kMost = 1000;  // Slurm's own limit of an array's size is 1001
  const std::size_t usual = std::min(kMost, (runs + kRunsPerShard - 1) / kRunsPerShard);
  return static_cast<int>(std::min(runs, request.shards > 0 ? static_cast<std::size_t>(request.shards) : usual));
}

/// The watching side of a sweep in a cluster.
class Cluster {
 public:
  explicit Cluster(const SlurmRequest& request)
      : request_(request),
        cases_(request.sweep.plan),
        folder_(request.sweep.out, request.sweep.fresh),
        path_(fs::canonical(request.sweep.out)),
        database_(path_ / "sweep.db", Database::Mode::kWrite),
        begin_(Clock::now()) {
    CheckSameSweep(database_, cases_);
    const int shards = ShardsOf(request, path_);
    if (shards > slurm::MaxArraySize()) {
      throw base::InputError("--shards " + std::to_string(shards) + ": this cluster's arrays hold " +
                             std::to_string(slurm::MaxArraySize()) + " tasks at most");
    }
    for (int i = 0; i < shards; ++i) shards_.push_back({.shard = i});
    for (std::size_t i = 0; i < request.sweep.plan.seeds.size(); ++i) {
      shard_of_[request.sweep.plan.seeds[i]] = i % static_cast<std::size_t>(shards);
      ++shards_[i % static_cast<std::size_t>(shards)].cases;
    }
    std::error_code error;
    fs::create_directories(path_ / "shards", error);
    if (!error) fs::create_directories(slurm::LogFolder(path_), error);
    if (error) throw base::InputError("--out: cannot write to " + path_.string() + " (" + error.message() + ")");
    WriteFile("--out", path_ / "plan.json", internal::WorkersPlan(request.sweep, shards));
  }

  SlurmResult Run() {
    SlurmResult result;
    const sigset_t before = BlockInterrupts();
    Merge();
    while (!Done()) {
      if (Clock::now() >= next_question_) Ask(result);
      if (!request_.watch) break;
      Tell();
      if (Interrupted()) {
        result.sweep.interrupted = true;
        break;
      }
      Merge();
    }
    result.finished = Done();
    if (result.finished) EndWhatIsLeft();
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    const bool interrupted = result.sweep.interrupted;
    result.sweep = ResultOf(request_.sweep, cases_, database_);
    result.sweep.interrupted = interrupted;
    result.sweep.flown = merged_;
    result.sweep.wall_s = Seconds();
    return result;
  }

 private:
  bool Done() {
    if (std::all_of(shards_.begin(), shards_.end(), [](const auto& shard) { return shard.complete(); })) return true;
    if (request_.sweep.requirements.empty()) return false;
    const SweepResult now = ResultOf(request_.sweep, cases_, database_);
    return std::all_of(now.requirements.begin(), now.requirements.end(),
                       [](const SweepResult::Decided& d) { return d.decision != statistics::Decision::kUndecided; });
  }

  /// Takes over what the shards have written since the last look. A file that was written moments ago is looked at
  /// again: the clocks of file systems are coarse.
  void Merge() {
    for (slurm::ShardProgress& shard : shards_) {
      if (shard.complete() && shard.cases > 0) continue;
      const fs::path file = ShardFile(path_, shard.shard);
      std::error_code error;
      const fs::file_time_type written = fs::last_write_time(file, error);
      if (error || (seen_[shard.shard] == written && fs::file_time_type::clock::now() - written > kFresh)) continue;
      merged_ += static_cast<std::size_t>(database_.Merge(file));
      seen_[shard.shard] = written;
    }
    for (slurm::ShardProgress& shard : shards_) shard.done = 0;
    for (const std::uint64_t seed : database_.Seeds()) {
      const auto found = shard_of_.find(seed);
      if (found != shard_of_.end()) ++shards_[found->second].done;
    }
  }

  /// Asks the queue, and submits what is neither there nor flown. The first submission must succeed; after that a
  /// controller that is away for a while, or a quota, is said and tried again.
  void Ask(SlurmResult& result) {
    next_question_ = Clock::now() + kBetweenQuestions;
    const slurm::QueueState queue = slurm::AskQueue(slurm::JobName(path_));
    if (!queue.known) {
      if (!request_.watch) throw base::FaultError("slurm", "the queue cannot be asked now: " + queue.problem);
      return Say("the queue cannot be asked now: " + queue.problem);
    }
    queue_ = queue;
    Merge();  // rows are counted after the queue has answered
    const slurm::Resubmission now = slurm::ShardsToResubmit(shards_, queue);
    if (!now.give_up.empty()) throw base::FaultError("slurm", now.give_up);
    try {
      if (!now.cancel.empty()) slurm::Cancel(now.cancel);
      if (now.shards.empty() || Done()) return;
      result.job = slurm::Submit(slurm::BatchScript(JobOf(request_, path_, now.shards)));
      submitted_ = true;
      slurm::CountAttempt(shards_, now.shards);
      Say("job " + result.job + ": shards " + slurm::ArrayExpression(now.shards) + " submitted");
    } catch (const base::FaultError& e) {
      if (!request_.watch || e.reason() != "slurm_unavailable") throw;
      Say(e.what());
    } catch (const base::InputError& e) {
      if (!submitted_) throw;
      Say(e.what());
    }
  }

  /// Runs that nobody needs any more, where a requirement was decided early. That they go on is no fault of the sweep.
  void EndWhatIsLeft() const {
    std::set<std::string> jobs;
    for (const slurm::Task& task : queue_.tasks) {
      const std::size_t shard = static_cast<std::size_t>(task.shard);
      const bool needless = task.shard >= 0 && shard < shards_.size() && !shards_[shard].complete();
      if (task.state != slurm::TaskState::kEnded && needless) jobs.insert(task.job);
    }
    if (jobs.empty()) return;
    try {
      slurm::Cancel({jobs.begin(), jobs.end()});
    } catch (const std::exception& e) {
      Say(std::string("what is left in the queue could not be cancelled: ") + e.what());
    }
  }

  void Say(const std::string& line) const {
    if (request_.tell) request_.tell(line);
  }

  double Seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  void Tell() {
    if (!request_.sweep.news) return;
    const SweepResult now = ResultOf(request_.sweep, cases_, database_);
    SweepNews news{
        .done = now.rows.size(), .planned = now.planned, .seconds = Seconds(), .flown = merged_, .row = nullptr};
    for (const Row& one : now.rows) {
      news.passes += one.verdict.outcome == Outcome::kPass;
      news.failures += one.verdict.outcome == Outcome::kFail;
      news.faults += one.verdict.outcome == Outcome::kFault;
    }
    request_.sweep.news(news);
  }

  static sigset_t BlockInterrupts() {
    sigset_t signals, before;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGINT);
    ::sigaddset(&signals, SIGTERM);
    ::sigprocmask(SIG_BLOCK, &signals, &before);
    return before;
  }

  /// Waits for the next look; true where Ctrl-C came.
  static bool Interrupted() {
    sigset_t signals;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGINT);
    ::sigaddset(&signals, SIGTERM);
    const timespec timeout{kGlance.count() / 1000, (kGlance.count() % 1000) * 1'000'000};
    return ::sigtimedwait(&signals, nullptr, &timeout) > 0;
  }

  const SlurmRequest& request_;
  CaseMaker cases_;
  SweepFolder folder_;
  fs::path path_;
  Database database_;
  std::vector<slurm::ShardProgress> shards_;
  std::map<std::uint64_t, std::size_t> shard_of_;  // by seed
  std::map<int, fs::file_time_type> seen_;
  slurm::QueueState queue_;  // as last known
  bool submitted_ = false;
  Clock::time_point next_question_{};
  std::size_t merged_ = 0;
  Clock::time_point begin_;
};

}  // namespace

std::string DryRun(const SlurmRequest& request) {
  const CaseMaker cases(request.sweep.plan);  // what is wrong with the sweep shows now
  const fs::path folder = fs::absolute(request.sweep.out).lexically_normal();
  std::vector<int> all(static_cast<std::size_t>(ShardsOf(request, folder)));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return slurm::BatchScript(JobOf(request, folder, all));
}

SlurmResult RunSlurmSweep(const SlurmRequest& request) {
  slurm::AskQueue(slurm::JobName(fs::absolute(request.sweep.out)));  // without Slurm nothing is begun
  return Cluster(request).Run();
}

}  // namespace alula::scenarios::campaign
