#include "stack/pilot/job_queue.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace alula::stack::pilot {

namespace {

/// Processor time of this thread, ms: what a busy machine does not change.
double CpuNow() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

JobQueue::JobQueue(int workers) {
  for (int i = 0; i < workers; ++i) threads_.emplace_back([this] { WorkerLoop(); });
}

JobQueue::~JobQueue() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void JobQueue::Execute(Job& job) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = CpuNow();
  try {
    job.work();
  } catch (...) {
    job.error = std::current_exception();
  }
  job.work = nullptr;  // what the job captured is released where it ran
  job.cpu_ms = CpuNow() - cpu_begin;
  job.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

bool JobQueue::Enqueue(const std::string& stage, const std::string& strand, base::Time now, base::Duration latency,
                       std::function<void()> work, std::function<void()> join) {
  if (busy_[stage]) {
    ++skipped_[stage];
    return false;
  }
  busy_[stage] = true;
  auto job = std::make_shared<Job>();
  job->number = next_number_++;
  job->stage = stage;
  job->strand = strand;
  job->due = Due(now, latency);
  job->work = std::move(work);
  job->join = std::move(join);
  pending_.emplace(std::make_pair(job->due, job->number), job);
  if (threads_.empty()) {
    Execute(*job);
    job->finished = true;
    return true;
  }
  {
    const std::lock_guard lock(mutex_);
    Strand& queue = strands_[strand];
    queue.waiting.push_back(job);
    if (!queue.running && queue.waiting.size() == 1) runnable_.push_back(strand);
  }
  work_ready_.notify_one();
  return true;
}

void JobQueue::WorkerLoop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_ready_.wait(lock, [this] { return stopping_ || !runnable_.empty(); });
    if (stopping_) return;
    const std::string name = runnable_.front();
    runnable_.pop_front();
    Strand& strand = strands_[name];
    const std::shared_ptr<Job> job = strand.waiting.front();
    strand.waiting.pop_front();
    strand.running = true;
    lock.unlock();
    Execute(*job);
    lock.lock();
    strand.running = false;
    if (!strand.waiting.empty()) {
      runnable_.push_back(name);
      work_ready_.notify_one();
    }
    job->finished = true;
    job_finished_.notify_all();
  }
}

void JobQueue::Join(base::Time now) {
  while (!pending_.empty() && pending_.begin()->first.first <= now) {
    const std::shared_ptr<Job> job = pending_.begin()->second;
    pending_.erase(pending_.begin());
    {
      std::unique_lock lock(mutex_);
      job_finished_.wait(lock, [&job] { return job->finished; });
    }
    busy_[job->stage] = false;
    Spent& spent = spent_[job->stage];
    spent.wall_ms += job->wall_ms;
    spent.cpu_ms.push_back(static_cast<float>(job->cpu_ms));
    if (job->error) std::rethrow_exception(job->error);
    job->join();
  }
}

std::uint64_t JobQueue::skipped(const std::string& stage) const {
  const auto found = skipped_.find(stage);
  return found == skipped_.end() ? 0 : found->second;
}

std::vector<StageTime> JobQueue::Timing() const {
  std::vector<StageTime> result;
  for (const auto& [stage, spent] : spent_) {
    StageTime time{.name = stage, .wall_ms = spent.wall_ms, .calls = spent.cpu_ms.size()};
    std::vector<float> sorted = spent.cpu_ms;
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty()) {
      const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(sorted.size())));
      time.p99_ms = static_cast<double>(sorted[std::max<std::size_t>(rank, 1) - 1]);
    }
    result.push_back(std::move(time));
  }
  return result;
}

}  // namespace alula::stack::pilot
