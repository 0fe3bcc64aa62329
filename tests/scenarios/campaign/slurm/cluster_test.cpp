#include "tests/scenarios/campaign/slurm/cluster.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "scenarios/campaign/slurm/batch_script.h"
#include "scenarios/campaign/slurm/queue.h"
#include "scenarios/campaign/slurm/resubmission.h"
#include "scenarios/campaign/slurm/run_command.h"

namespace alula::scenarios::slurm {
namespace {

using scenarios::testing::TemporaryFolder;
using testing::Cluster;

/// A line of the journal that the stub workers write.
struct Event {
  int shard = 0;
  int pid = 0;
  std::string node, what;
  int number = -1;
};

/// A sweep of stub workers, watched as `alula sweep --watch` does it.
class Sweep {
 public:
  Sweep(const std::string& name, int shards, int cases, int case_ms) : folder_(name) {
    // A path that no quoting may stumble over.
    job_.folder = folder_.path() / "it's \"100%j\" $HOME #1";
    job_.binary = ALULA_STUB_WORKER;
    job_.name = JobName(job_.folder);
    job_.environment = {{"STUB_CASES", std::to_string(cases)}, {"STUB_CASE_MS", std::to_string(case_ms)}};
    std::filesystem::create_directories(job_.folder / "shards");
    std::filesystem::create_directories(LogFolder(job_.folder));
    for (int k = 0; k < shards; ++k) shards_.push_back({.shard = k, .cases = cases});
  }

  /// One look: the queue first, then the rows.
  void Step() {
    queue_ = AskQueue(job_.name);
    for (ShardProgress& shard : shards_) shard.done = static_cast<int>(Rows(shard.shard).size());
    const Resubmission now = ShardsToResubmit(shards_, queue_);
    ASSERT_EQ(now.give_up, "");
    if (now.shards.empty()) return;
    Cancel(now.cancel);
    job_.shards = now.shards;
    submissions_.push_back(Submit(BatchScript(job_)));
    CountAttempt(shards_, now.shards);
  }

  /// Watches until something holds.
  void WatchUntil(const std::string& what, const std::function<bool()>& holds) {
    constexpr int kLooks = 600;  // of 0.3 s: three minutes
    for (int look = 0; look < kLooks; ++look) {
      ASSERT_NO_FATAL_FAILURE(Step());
      if (holds()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    FAIL() << "never: " << what << "\n" << Dump();
  }

  bool Complete() const {
    return std::all_of(shards_.begin(), shards_.end(), [](const ShardProgress& shard) { return shard.complete(); });
  }

  std::vector<int> Rows(int shard) const {
    std::vector<int> rows;
    std::ifstream stream(job_.folder / "shards" / (std::to_string(shard) + ".rows"));
    for (int number; stream >> number;) rows.push_back(number);
    return rows;
  }

  std::vector<Event> Journal() const {
    std::vector<Event> events;
    std::ifstream stream(job_.folder / "journal");
    Event event;
    while (stream >> event.shard >> event.pid >> event.node >> event.what >> event.number) events.push_back(event);
    return events;
  }

  bool Happened(const std::string& node, const std::string& what, int at_least = 1) const {
    int count = 0;
    for (const Event& event : Journal()) count += event.node == node && event.what == what ? 1 : 0;
    return count >= at_least;
  }

  int TasksOn(const std::string& node) const {
    std::set<int> shards;
    for (const Event& event : Journal()) {
      if (event.node == node) shards.insert(event.shard);
    }
    return static_cast<int>(shards.size());
  }

  /// The tasks that wait in the queue though they have run before.
  std::vector<Task> Requeued() const {
    std::vector<Task> tasks;
    for (const Task& task : queue_.tasks) {
      if (task.state == TaskState::kWaiting && task.reason == "BeginTime") tasks.push_back(task);
    }
    return tasks;
  }

  /// Every case of every shard once, in order; and no two processes at work on one shard at the same time.
  void ExpectNothingTwice() const {
    for (const ShardProgress& shard : shards_) {
      std::vector<int> all;
      for (int number = 0; number < shard.cases; ++number) all.push_back(number);
      EXPECT_EQ(Rows(shard.shard), all) << "shard " << shard.shard;
    }
    std::map<int, int> holder;              // of a shard: who claimed it last
    std::map<int, std::set<int>> finished;  // of a shard: who had it before
    for (const Event& event : Journal()) {
      if (event.what == "start" || event.what == "wait") continue;
      if (event.what == "claim") {
        finished[event.shard].insert(holder[event.shard]);
        holder[event.shard] = event.pid;
      }
      EXPECT_EQ(event.pid, holder[event.shard]) << "shard " << event.shard << " " << event.what;
      EXPECT_FALSE(finished[event.shard].contains(event.pid)) << "shard " << event.shard << " " << event.what;
      EXPECT_NE(event.what, "lost");
    }
  }

  std::string Dump() const {
    std::ostringstream text;
    for (const Task& task : queue_.tasks) {
      text << task.job << "_" << task.shard << " " << task.slurm_state << " " << task.reason << "\n";
    }
    text << scenarios::testing::ReadText(job_.folder / "journal");
    for (const auto& log : std::filesystem::directory_iterator(LogFolder(job_.folder))) {
      text << log.path().filename() << ": " << scenarios::testing::ReadText(log.path()) << "\n";
    }
    return text.str();
  }

  const QueueState& queue() const { return queue_; }
  const std::vector<std::string>& submissions() const { return submissions_; }
  SlurmJob& job() { return job_; }

 private:
  TemporaryFolder folder_;
  SlurmJob job_;
  std::vector<ShardProgress> shards_;
  QueueState queue_;
  std::vector<std::string> submissions_;
};

class SlurmCluster : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string why = testing::WhyNoCluster();
    if (!why.empty()) GTEST_SKIP() << why;
    cluster_ = std::make_unique<Cluster>();
  }
  std::unique_ptr<Cluster> cluster_;
};

TEST_F(SlurmCluster, ANodeDiesWithAllThatRunsOnIt) {
  Sweep sweep("slurm_node", 6, 6, 500);
  sweep.WatchUntil("both nodes work",
                   [&] { return sweep.Happened("n1", "begin", 3) && sweep.Happened("n2", "begin"); });
  cluster_->KillNode("n1");
  sweep.WatchUntil("Slurm requeues", [&] { return sweep.Requeued().size() == 2; });
  EXPECT_EQ(sweep.submissions().size(), 1u) << "as long as Slurm has a task it is not submitted again";
  // One is lost to the queue, as where a site forbids requeueing; Slurm may start the other.
  const Task lost = sweep.Requeued().front();
  Cancel({lost.job + "_" + std::to_string(lost.shard)});
  cluster_->Hurry();
  sweep.WatchUntil("the sweep is complete", [&] { return sweep.Complete(); });
  sweep.ExpectNothingTwice();
  EXPECT_EQ(sweep.submissions().size(), 2u);
  EXPECT_EQ(sweep.job().shards, std::vector<int>{lost.shard});
}

TEST_F(SlurmCluster, ADaemonDiesAndItsTasksLiveOn) {
  // Three shards on four processors: the survivor has room for a task of the other node, whose old one still works.
  Sweep sweep("slurm_zombie", 3, 45, 1000);
  sweep.WatchUntil("both nodes work", [&] {
    return sweep.Happened("n1", "begin") && sweep.Happened("n2", "begin") &&
           sweep.TasksOn("n1") + sweep.TasksOn("n2") == 3;
  });
  const std::string dead = sweep.TasksOn("n1") == 2 ? "n1" : "n2", alive = dead == "n1" ? "n2" : "n1";
  cluster_->KillDaemon(dead);
  sweep.WatchUntil("Slurm requeues", [&] { return sweep.Requeued().size() == 2; });
  cluster_->Hurry();
  sweep.WatchUntil("a new task waits for an old one", [&] { return sweep.Happened(alive, "wait"); });
  EXPECT_FALSE(sweep.Happened(dead, "complete"));
  sweep.WatchUntil("the sweep is complete", [&] { return sweep.Complete(); });
  EXPECT_TRUE(sweep.Happened(dead, "complete", 2)) << "the old tasks have done all";
  EXPECT_EQ(sweep.submissions().size(), 1u);
  sweep.ExpectNothingTwice();
}

TEST_F(SlurmCluster, ASecondTaskWaitsForTheFirst) {
  Sweep sweep("slurm_second", 1, 10, 500);
  sweep.WatchUntil("it works", [&] { return !sweep.Journal().empty(); });
  Submit(BatchScript(sweep.job()));  // as after a submission whose answer got lost
  sweep.WatchUntil("the sweep is complete", [&] { return sweep.Complete(); });
  sweep.WatchUntil("both ended", [&] {
    return std::all_of(sweep.queue().tasks.begin(), sweep.queue().tasks.end(),
                       [](const Task& task) { return task.slurm_state == "COMPLETED"; });
  });
  EXPECT_EQ(sweep.queue().tasks.size(), 2u) << "found by the sweep's name";
  EXPECT_TRUE(sweep.Happened("n1", "wait") || sweep.Happened("n2", "wait"));
  sweep.ExpectNothingTwice();
}

TEST_F(SlurmCluster, TheControllerRestarts) {
  Sweep sweep("slurm_controller", 4, 6, 500);
  sweep.WatchUntil("it works", [&] { return sweep.Happened("n1", "begin") && sweep.Happened("n2", "begin"); });
  cluster_->KillController();
  for (int look = 0; look < 2; ++look) {
    sweep.Step();
    EXPECT_FALSE(sweep.queue().known);
    EXPECT_NE(sweep.queue().problem, "");
  }
  try {
    Submit(BatchScript(sweep.job()));
    FAIL() << "submitted to nobody";
  } catch (const base::FaultError& error) {
    EXPECT_EQ(error.reason(), "slurm_unavailable");
  }
  cluster_->StartController();
  sweep.WatchUntil("the sweep is complete", [&] { return sweep.Complete(); });
  EXPECT_EQ(sweep.submissions().size(), 1u);
  sweep.ExpectNothingTwice();
}

TEST_F(SlurmCluster, ATaskIsToldBeforeSlurmTakesItsPlace) {
  Sweep sweep("slurm_preempted", 1, 8, 500);
  sweep.WatchUntil("it works", [&] { return sweep.Happened("n1", "begin", 2) || sweep.Happened("n2", "begin", 2); });
  const std::string task = sweep.submissions().front() + "_0";
  const CommandOutcome requeue = RunCommand({"scontrol", "requeue", task});  // what pre-emption does
  ASSERT_EQ(requeue.exit_code, 0) << requeue.err;
  sweep.WatchUntil("it ends of its own will",
                   [&] { return sweep.Happened("n1", "term") || sweep.Happened("n2", "term"); });
  sweep.WatchUntil("it waits in the queue", [&] { return sweep.Requeued().size() == 1; });
  cluster_->Hurry();
  sweep.WatchUntil("the sweep is complete", [&] { return sweep.Complete(); });
  EXPECT_EQ(sweep.submissions().size(), 1u);
  sweep.ExpectNothingTwice();
}

TEST_F(SlurmCluster, RefusesInItsOwnWords) {
  Sweep sweep("slurm_refused", 1, 1, 1);
  sweep.job().shards = {0};
  sweep.job().options = {"--partition=nosuch"};
  try {
    Submit(BatchScript(sweep.job()));
    FAIL() << "taken";
  } catch (const base::InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("Slurm refuses: sbatch: invalid partition specified: nosuch; "))
        << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  sweep.job().options = {};
  sweep.job().shards = {MaxArraySize()};
  EXPECT_THROW(Submit(BatchScript(sweep.job())), base::InputError);
  sweep.job().shards = {MaxArraySize() - 1};
  const std::string id = Submit(BatchScript(sweep.job()));
  Cancel({id});
  Cancel({id, "4711"});
  for (const Task& task : AskQueue(sweep.job().name).tasks) {
    EXPECT_EQ(task.shard, MaxArraySize() - 1);
    EXPECT_NE(task.state, TaskState::kWaiting);
  }
}

}  // namespace
}  // namespace alula::scenarios::slurm
