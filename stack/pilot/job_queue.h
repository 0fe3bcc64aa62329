#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/time.h"
#include "stack/interface/navigation_stack.h"

namespace alula::stack::pilot {

/// Slow work whose duration is declared, not measured: a job starts at simulated time t and its result is taken over
/// at exactly t + latency, however fast the machine is and with any number of workers.
///
/// - Jobs of one *strand* run one after another in the order of their numbers, so they may share mutable state that
///   nobody else touches. Jobs of different strands may run at once and may share only what is immutable.
/// - Takeovers ("joins") run in the thread that calls Join, ordered by (due time, job number).
/// - On a slower machine (Stretch) a declared latency is multiplied before it counts.
/// - A *stage* has at most one job under way: a turn that comes before the last one was joined is skipped and counted.
/// - An exception in a job is thrown by the Join that takes the job over.
///
/// The wall time of each job is measured for Timing() and enters nothing else.
class JobQueue {
 public:
  /// `workers` threads; with 0 each job runs in the caller, inside Start.
  explicit JobQueue(int workers);
  /// Waits for jobs that run, drops those that have not begun.
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Starts `work` at `now`; `join(result)` is called by the first Join at or after now + latency. Returns false, and
  /// counts a skipped turn, when the stage's last job has not been joined yet.
  template <typename Work, typename JoinFn>
  bool Start(const std::string& stage, const std::string& strand, base::Time now, base::Duration latency, Work work,
             JoinFn join) {
    using Result = decltype(work());
    auto result = std::make_shared<std::unique_ptr<Result>>();
    return Enqueue(
        stage, strand, now, latency,
        [result, work = std::move(work)]() mutable { *result = std::make_unique<Result>(work()); },
        [result, join = std::move(join)]() mutable { join(std::move(**result)); });
  }

  /// A slower machine: latencies of jobs started from now on are multiplied by `factor`. Jobs under way keep theirs.
  void Stretch(double factor) { factor_ = factor; }
  /// When a job started at `now` is taken over.
  base::Time Due(base::Time now, base::Duration latency) const {
    return now + (factor_ == 1.0 ? latency : base::Seconds(factor_ * latency.Seconds()));
  }

  /// Takes over every job that is due at `now`, waiting for those that are still being computed. A join may start new
  /// jobs; one that is due at once is taken over in the same call.
  void Join(base::Time now);

  bool Busy(const std::string& stage) const { return busy_.contains(stage) && busy_.at(stage); }
  /// Number of the next job: part of the seed of random work ("planner/17").
  std::uint64_t next_number() const { return next_number_; }
  std::uint64_t skipped(const std::string& stage) const;
  /// Wall time, calls and the 99th percentile of a call's processor time by stage, in the order of the stages' names.
  std::vector<StageTime> Timing() const;

 private:
  struct Job {
    std::uint64_t number = 0;
    std::string stage;
    std::string strand;
    base::Time due;
    std::function<void()> work;
    std::function<void()> join;
    bool finished = false;
    std::exception_ptr error;
    double wall_ms = 0.0;
    double cpu_ms = 0.0;
  };
  struct Strand {
    std::deque<std::shared_ptr<Job>> waiting;
    bool running = false;
  };

  bool Enqueue(const std::string& stage, const std::string& strand, base::Time now, base::Duration latency,
               std::function<void()> work, std::function<void()> join);
  static void Execute(Job& job);
  void WorkerLoop();

  std::map<std::pair<base::Time, std::uint64_t>, std::shared_ptr<Job>> pending_;  // by (due time, job number)
  std::map<std::string, bool> busy_;
  std::map<std::string, std::uint64_t> skipped_;
  struct Spent {
    double wall_ms = 0.0;
    std::vector<float> cpu_ms;  // of each call
  };
  std::map<std::string, Spent> spent_;
  std::uint64_t next_number_ = 0;
  double factor_ = 1.0;  // on latencies

  mutable std::mutex mutex_;  // guards what follows, and Job::finished
  std::condition_variable work_ready_;
  std::condition_variable job_finished_;
  std::map<std::string, Strand> strands_;
  std::deque<std::string> runnable_;  // strands with work and no worker, first come first served
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace alula::stack::pilot
