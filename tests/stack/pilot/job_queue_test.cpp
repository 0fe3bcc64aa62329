#include "stack/pilot/job_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.h"

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;

Time At(std::int64_t ms) { return Time{ms * 1'000'000}; }

TEST(JobQueue, JoinsExactlyAtTheDeclaredLatency) {
  for (const int workers : {0, 1, 2}) {
    JobQueue jobs(workers);
    int result = 0;
    ASSERT_TRUE(jobs.Start(
        "a", "a", At(10), Milliseconds(40), [] { return 7; }, [&](int r) { result = r; }));
    jobs.Join(At(49));
    EXPECT_EQ(result, 0);
    EXPECT_TRUE(jobs.Busy("a"));
    jobs.Join(At(50));
    EXPECT_EQ(result, 7);
    EXPECT_FALSE(jobs.Busy("a"));
  }
}

TEST(JobQueue, ASlowerMachineStretchesWhatIsStartedFromThenOn) {
  for (const int workers : {0, 2}) {
    JobQueue jobs(workers);
    std::string order;
    const auto start = [&](const char* name, int latency) {
      jobs.Start(
          name, name, At(0), Milliseconds(latency), [] { return 0; }, [&order, name](int) { order += name; });
    };
    start("a", 40);
    jobs.Stretch(2.5);
    start("b", 20);
    EXPECT_EQ(jobs.Due(At(0), Milliseconds(20)), At(50));
    jobs.Stretch(1.0);
    start("c", 45);
    jobs.Join(At(49));
    EXPECT_EQ(order, "ac");
    jobs.Join(At(50));
    EXPECT_EQ(order, "acb");
  }
}

TEST(JobQueue, JoinsInOrderOfDueTimeThenNumber) {
  for (const int workers : {0, 1, 3}) {
    JobQueue jobs(workers);
    std::string order;
    const auto start = [&](const char* name, int latency) {
      jobs.Start(
          name, name, At(0), Milliseconds(latency), [] { return 0; }, [&order, name](int) { order += name; });
    };
    start("a", 30);
    start("b", 10);
    start("c", 30);
    start("d", 20);
    jobs.Join(At(100));
    EXPECT_EQ(order, "bdac");
  }
}

TEST(JobQueue, SkipsATurnWhileTheLastIsUnderWay) {
  JobQueue jobs(1);
  int joined = 0;
  for (int i = 0; i < 10; ++i) {
    jobs.Join(At(10 * i));
    jobs.Start(
        "slow", "s", At(10 * i), Milliseconds(25), [] { return 0; }, [&](int) { ++joined; });
  }
  jobs.Join(At(1000));
  EXPECT_EQ(joined, 4);  // started at 0, 30, 60, 90
  EXPECT_EQ(jobs.skipped("slow"), 6U);
  EXPECT_EQ(jobs.skipped("fast"), 0U);
}

TEST(JobQueue, CarriesExceptionsToTheJoin) {
  for (const int workers : {0, 2}) {
    JobQueue jobs(workers);
    jobs.Start(
        "bad", "s", At(0), Milliseconds(5), []() -> int { throw std::runtime_error("broken"); }, [](int) { FAIL(); });
    jobs.Join(At(4));
    EXPECT_THROW(jobs.Join(At(5)), std::runtime_error);
    jobs.Join(At(6));
    EXPECT_FALSE(jobs.Busy("bad"));
  }
}

TEST(JobQueue, JobsOfAStrandNeverOverlap) {
  JobQueue jobs(4);
  std::atomic<int> inside = 0;
  int most = 0;  // written on one strand only
  for (int i = 0; i < 40; ++i) {
    jobs.Start(
        "stage" + std::to_string(i), "one", At(0), Milliseconds(i),
        [&] {
          most = std::max(most, ++inside);
          std::this_thread::yield();
          --inside;
          return 0;
        },
        [](int) {});
  }
  jobs.Join(At(100));
  EXPECT_EQ(most, 1);
}

TEST(JobQueue, MeasuresWallTimeByStage) {
  JobQueue jobs(1);
  for (int i = 0; i < 5; ++i) {
    jobs.Start(
        "x", "x", At(i), Milliseconds(0), [] { return 0; }, [](int) {});
    jobs.Join(At(i));
  }
  const auto timing = jobs.Timing();
  ASSERT_EQ(timing.size(), 1U);
  EXPECT_EQ(timing[0].name, "x");
  EXPECT_EQ(timing[0].calls, 5U);
  EXPECT_GE(timing[0].wall_ms, 0.0);
  EXPECT_LE(timing[0].p99_ms, timing[0].wall_ms);
}

/// A little world of stages that feed each other, with mutable state on two strands, uneven work and skipped turns.
std::uint64_t Simulate(int workers) {
  JobQueue jobs(workers);
  base::RollingHash hash;
  std::uint64_t odometry = 1, map = 1;  // each belongs to one strand
  std::uint64_t latest = 0;
  for (int ms = 0; ms < 800; ++ms) {
    jobs.Join(At(ms));
    if (ms % 50 == 0) {
      jobs.Start(
          "odometry", "odometry", At(ms), Milliseconds(40),
          [&odometry, ms] {
            for (int k = 0; k < 1000 * (ms % 7); ++k) odometry = odometry * 6364136223846793005ULL + 1;
            return odometry;
          },
          [&, ms](std::uint64_t pose) {
            hash.Add(pose);
            latest = pose;
            jobs.Start(
                "mapping", "mapping", At(ms + 40), Milliseconds(80),
                [&map, pose] {
                  for (int k = 0; k < 5000; ++k) map = map * 6364136223846793005ULL + pose;
                  return map;
                },
                [&](std::uint64_t m) { hash.Add(m); });
          });
    }
    if (ms % 33 == 0) {
      jobs.Start(
          "planning", "mapping", At(ms), Milliseconds(100), [&map, latest] { return map ^ latest; },
          [&](std::uint64_t p) { hash.Add(p); });
    }
  }
  hash.Add(jobs.skipped("planning"));
  hash.Add(jobs.skipped("mapping"));
  return hash.value();
}

TEST(JobQueue, SameResultWithAnyNumberOfWorkers) {
  const std::uint64_t expected = Simulate(0);
  for (const int workers : {1, 2, 8}) {
    for (int repeat = 0; repeat < 3; ++repeat) EXPECT_EQ(Simulate(workers), expected) << workers << " workers";
  }
}

TEST(JobQueue, IsDestroyedWithWorkUnderWay) {
  JobQueue jobs(2);
  for (int i = 0; i < 10; ++i) {
    jobs.Start(
        "s" + std::to_string(i), "s", At(0), Milliseconds(50), [] { return 0; }, [](int) {});
  }
}

}  // namespace
}  // namespace alula::stack::pilot
