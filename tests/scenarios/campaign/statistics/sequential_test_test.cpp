#include "scenarios/campaign/statistics/sequential_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/random.h"

namespace alula::scenarios::statistics {
namespace {

constexpr RateRequirement kRequirement{0.95, 0.95};

/// Brute-force twin: the mean of the likelihood ratio over the prior, by the midpoint rule.
double EvidenceBySum(double rate, double s, double f) {
  constexpr int kSteps = 400000;
  const double b = std::clamp(0.5 * (1.0 - rate) / rate, 0.25, 50.0);
  double above = 0.0, below = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double v = (i + 0.5) / kSteps;
    const double rest = (1.0 - rate) * std::pow(v, 4.0);  // takes the pole at p = 1 away
    const double p = 1.0 - rest;
    const double prior = std::pow(p, -0.5) * std::pow(rest, b - 1.0) * std::pow(v, 3.0);
    above += prior * std::pow(p / rate, s) * std::pow(rest / (1.0 - rate), f);
    below += prior;
  }
  return above / below;
}

TEST(SequentialTest, EvidenceIsTheMeanLikelihoodRatio) {
  for (const double rate : {0.3, 0.8, 0.95, 0.99}) {
    for (const auto& [s, f] : {std::pair{0, 0}, {5, 0}, {60, 0}, {40, 3}, {0, 4}}) {
      // 1e-5: the midpoint rule near the (softened) pole.
      EXPECT_NEAR(LogEvidenceAbove(rate, s, f), std::log(EvidenceBySum(rate, s, f)), 1e-5) << rate << " " << s;
      EXPECT_DOUBLE_EQ(LogEvidenceBelow(1.0 - rate, f, s), LogEvidenceAbove(1.0 - (1.0 - rate), s, f));
    }
  }
}

// A martingale: at the tested rate the next run leaves the evidence as it is on average. Below it, it shrinks.
TEST(SequentialTest, EvidenceIsAFairGame) {
  for (const double rate : {0.1, 0.5, 0.95, 0.999}) {
    for (const auto& [s, f] : {std::pair{0, 0}, {10, 1}, {300, 7}, {1, 20}}) {
      const double now = LogEvidenceAbove(rate, s, f);
      const double passed = std::exp(LogEvidenceAbove(rate, s + 1, f) - now);
      const double failed = std::exp(LogEvidenceAbove(rate, s, f + 1) - now);
      EXPECT_NEAR(rate * passed + (1.0 - rate) * failed, 1.0, 1e-9) << rate << " " << s << " " << f;
      EXPECT_LT(0.9 * rate * passed + (1.0 - 0.9 * rate) * failed, 1.0);
    }
  }
}

// Bounds invert the test only if more demanding rates have less evidence.
TEST(SequentialTest, EvidenceFallsWithTheRate) {
  for (const auto& [s, f] : {std::pair{1, 0}, {1, 1}, {20, 0}, {57, 3}, {500, 2}, {3, 60}, {2, 900}}) {
    double before = std::numeric_limits<double>::infinity();
    for (double rate = 0.0005; rate < s / static_cast<double>(s + f); rate += 0.0005) {
      const double now = LogEvidenceAbove(rate, s, f);
      if (before > 0.0) {
        EXPECT_LE(now, before + 1e-9) << s << " " << f << " " << rate;
      }
      before = now;
    }
  }
}

TEST(SequentialTest, MillionsOfRuns) {
  for (const std::int64_t runs : {10000, 1000000}) {
    for (const double share : {0.0, 0.01, 0.05, 0.3, 1.0}) {
      const auto failures = static_cast<std::int64_t>(share * static_cast<double>(runs));
      EXPECT_TRUE(std::isfinite(LogEvidenceAbove(0.95, runs - failures, failures))) << runs << " " << share;
      EXPECT_TRUE(std::isfinite(LogEvidenceBelow(0.95, runs - failures, failures))) << runs << " " << share;
    }
  }
  EXPECT_NEAR(AnytimeLowerBound(990000, 10000, 0.95), 0.99, 1e-3);
  EXPECT_NEAR(AnytimeUpperBound(990000, 10000, 0.95), 0.99, 1e-3);
}

TEST(SequentialTest, FewestRunsConfirm) {
  const std::int64_t runs = RunsIfAllPass(kRequirement);
  EXPECT_EQ(runs, 67);
  SequentialTest test(kRequirement);
  for (std::int64_t i = 1; i < runs; ++i) EXPECT_EQ(test.Add(true), Decision::kUndecided);
  EXPECT_EQ(test.Add(true), Decision::kConfirmed);
  EXPECT_EQ(test.decided_after, runs);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(test.Add(false), Decision::kConfirmed);  // the first decision stands
  EXPECT_EQ(test.decided_after, runs);
}

TEST(SequentialTest, BoundAgreesWithTheDecision) {
  base::RandomStream random(4, "runs");
  SequentialTest test({0.8, 0.9});
  while (test.decision == Decision::kUndecided) {
    EXPECT_LT(AnytimeLowerBound(test.successes, test.failures, 0.9), 0.8);
    test.Add(random.Uniform() < 0.93);
  }
  EXPECT_EQ(test.decision, Decision::kConfirmed);
  EXPECT_GE(AnytimeLowerBound(test.successes, test.failures, 0.9), 0.8);
}

TEST(SequentialTest, NoRunsSayNothing) {
  const SequentialTest test(kRequirement);
  EXPECT_EQ(test.interval().low, 0.0);
  EXPECT_EQ(test.interval().high, 1.0);
}

struct Sweeps {
  int confirmed = 0;
  int rejected = 0;
  int median_runs = 0;  // to a decision; the most allowed where more than half are undecided
};

Sweeps Simulate(double p, int sweeps, int most_runs, const char* name) {
  Sweeps result;
  std::vector<int> runs;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    base::RandomStream random(static_cast<std::uint64_t>(sweep), name);
    SequentialTest test(kRequirement);
    int i = 0;
    while (i < most_runs && test.decision == Decision::kUndecided) {
      test.Add(random.Uniform() < p);
      ++i;
    }
    runs.push_back(i);
    result.confirmed += test.decision == Decision::kConfirmed ? 1 : 0;
    result.rejected += test.decision == Decision::kRejected ? 1 : 0;
  }
  std::nth_element(runs.begin(), runs.begin() + sweeps / 2, runs.end());
  result.median_runs = runs[static_cast<std::size_t>(sweeps) / 2];
  return result;
}

TEST(SequentialTest, WrongDecisionsAreRarerThanStated) {
  constexpr int kSweeps = 2000, kMostRuns = 1000;
  // 5 % of 2000 and three standard deviations sqrt(2000 · 0.05 · 0.95).
  const double most = 0.05 * kSweeps + 3.0 * std::sqrt(kSweeps * 0.05 * 0.95);
  const Sweeps below = Simulate(0.9499, kSweeps, kMostRuns, "below");
  const Sweeps at = Simulate(0.95, kSweeps, kMostRuns, "at");
  std::printf("p = 0.9499: %d of %d confirmed; p = 0.95: %d rejected; at most %.0f may be\n", below.confirmed, kSweeps,
              at.rejected, most);
  EXPECT_LE(below.confirmed, most);
  EXPECT_LE(at.rejected, most);
}

TEST(SequentialTest, Power) {
  constexpr int kSweeps = 200, kMostRuns = 2000;
  for (const double p : {1.0, 0.99, 0.98, 0.97, 0.92, 0.9, 0.85, 0.7}) {
    const Sweeps sweeps = Simulate(p, kSweeps, kMostRuns, "power");
    std::printf("p = %.2f against 0.95: median %4d runs, %3d confirmed, %3d rejected of %d\n", p, sweeps.median_runs,
                sweeps.confirmed, sweeps.rejected, kSweeps);
    EXPECT_GE(p >= 0.95 ? sweeps.confirmed : sweeps.rejected, 0.9 * kSweeps) << p;
  }
}

// The two-sided set holds at all run counts at once: the share of sweeps in which it ever misses p.
TEST(SequentialTest, IntervalHoldsAtEveryRun) {
  constexpr int kSweeps = 300, kMostRuns = 300;
  for (const double p : {0.6, 0.95}) {
    int missed = 0;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      base::RandomStream random(static_cast<std::uint64_t>(sweep), "interval");
      std::int64_t s = 0, f = 0;
      bool miss = false;
      for (int i = 0; i < kMostRuns && !miss; ++i) {
        ++(random.Uniform() < p ? s : f);
        // Outside the interval exactly if the evidence against p has reached 1/0.025 on one side.
        miss = std::max(LogEvidenceAbove(p, s, f), LogEvidenceBelow(p, s, f)) >= std::log(40.0);
      }
      missed += miss ? 1 : 0;
    }
    EXPECT_LE(missed, 0.05 * kSweeps + 3.0 * std::sqrt(kSweeps * 0.05 * 0.95)) << p;
  }
}

}  // namespace
}  // namespace alula::scenarios::statistics
