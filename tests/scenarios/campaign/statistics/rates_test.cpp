// Intervals and tests of success rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "scenarios/campaign/statistics/binomial.h"
#include "scenarios/campaign/statistics/requirement.h"
#include "scenarios/campaign/statistics/sequential_test.h"

namespace alula::scenarios::statistics {
namespace {

TEST(ClopperPearson, AgreesWithPublishedValues) {
  EXPECT_NEAR(ClopperPearson(60, 60, 0.95).low, std::pow(0.025, 1.0 / 60), 1e-9);
  EXPECT_EQ(ClopperPearson(60, 60, 0.95).high, 1.0);
  EXPECT_NEAR(LowerBound(60, 60, 0.95), std::pow(0.05, 1.0 / 60), 1e-9);  // 0.951
  EXPECT_NEAR(LowerBound(59, 60, 0.95), 0.9233, 5e-4);
  const Interval tenth = ClopperPearson(1, 10, 0.95);  // Clopper and Pearson 1934; R's binom.test(1, 10)
  EXPECT_NEAR(tenth.low, 0.002528579, 1e-8);
  EXPECT_NEAR(tenth.high, 0.445016117, 1e-8);
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).low, 0.0);
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).high, 1.0);
}

TEST(ClopperPearson, CoversTheRateAtLeastAsOftenAsItSays) {
  for (const double p : {0.5, 0.9, 0.99}) {
    for (std::int64_t n = 1; n <= 200; ++n) EXPECT_GE(ClopperPearsonCoverage(p, n, 0.95), 0.95) << p << " " << n;
  }
}

/// How often a sweep of up to `most` runs decides what it should not, or ends in `decision`.
struct Sweeps {
  double confirmed = 0.0, rejected = 0.0;
  double median_runs = 0.0;  // of those decided
};
Sweeps Simulate(double p, const RateRequirement& requirement, int sweeps, int most, const char* name) {
  base::RandomStream stream(7, name);
  std::vector<double> runs;
  Sweeps result;
  for (int i = 0; i < sweeps; ++i) {
    SequentialTest test(requirement);
    int n = 0;
    while (test.decision() == Decision::kUndecided && n < most) {
      test.Add(stream.Uniform() < p);
      ++n;
    }
    if (test.decision() == Decision::kUndecided) continue;
    runs.push_back(n);
    ++(test.decision() == Decision::kConfirmed ? result.confirmed : result.rejected);
  }
  std::sort(runs.begin(), runs.end());
  if (!runs.empty()) result.median_runs = runs[runs.size() / 2];
  result.confirmed /= sweeps;
  result.rejected /= sweeps;
  return result;
}

TEST(SequentialTest, KeepsItsErrorLevelHoweverOftenOneLooks) {
  constexpr int kSweeps = 2000;
  const double level = 0.05, bound = level + 3.0 * std::sqrt(level * (1.0 - level) / kSweeps);
  for (const auto& [limit, most] : {std::pair(0.8, 250), std::pair(0.95, 1000)}) {
    const RateRequirement requirement{limit, 1.0 - level};
    const Sweeps below = Simulate(limit - 1e-6, requirement, kSweeps, most, "below");
    const Sweeps at = Simulate(limit, requirement, kSweeps, most, "at");
    EXPECT_LE(below.confirmed, bound) << limit;
    EXPECT_LE(at.rejected, bound) << limit;
    std::printf("limit %.2f: confirmed %.4f of sweeps just below it, rejected %.4f at it (level %.2f)\n", limit,
                below.confirmed, at.rejected, level);
  }
}

TEST(SequentialTest, DecidesSoonWhereTheRateIsFarFromTheLimit) {
  const RateRequirement requirement{0.95, 0.95};
  const Sweeps good = Simulate(0.995, requirement, 200, 2000, "good"),
               bad = Simulate(0.8, requirement, 200, 2000, "bad");
  EXPECT_GE(good.confirmed, 0.97);  // each error may be made in 5 % at most
  EXPECT_GE(bad.rejected, 0.97);
  std::printf(
      "median runs to a decision on 0.95 @ 95%%: %.0f at a rate of 0.995, %.0f at 0.8, %lld without a failure\n",
      good.median_runs, bad.median_runs, static_cast<long long>(RunsIfAllPass(requirement)));
  EXPECT_LE(good.median_runs, 200);
  EXPECT_LE(bad.median_runs, 60);
  const std::int64_t all = RunsIfAllPass(requirement);
  EXPECT_GT(all, 59);  // what a test of a fixed number of runs needs
  EXPECT_LT(all, 90);
}

TEST(SequentialTest, EvidenceIsTheIntegralOfItsDefinition) {
  // Simpson's rule over p = sin²θ, in which Jeffreys' prior is flat.
  const double p0 = 0.9;
  const int s = 27, f = 3, n = 20'000;
  const auto integral = [&](double from, double to) {
    double sum = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double theta = from + (to - from) * i / n, p = std::sin(theta) * std::sin(theta);
      const double ratio = std::pow(p / p0, s) * std::pow((1.0 - p) / (1.0 - p0), f);
      sum += ratio * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
    }
    return sum / (3.0 * n);  // the mean over the interval
  };
  const double theta0 = std::asin(std::sqrt(p0));
  EXPECT_NEAR(LogEvidenceAgainstBelow(p0, s, f), std::log(integral(theta0, std::acos(-1.0) / 2)), 1e-9);
  EXPECT_NEAR(LogEvidenceAgainstAtLeast(p0, s, f), std::log(integral(0.0, theta0)), 1e-9);
}

TEST(SequentialTest, StandsALongSweep) {
  const double evidence = LogEvidenceAgainstBelow(0.95, 960'000, 40'000);
  EXPECT_TRUE(std::isfinite(evidence));
  EXPECT_GT(evidence, 100.0);
  SequentialTest test({0.95, 0.95});
  for (int i = 0; i < 100; ++i) test.Add(i % 10 != 0);
  const Interval interval = test.interval();
  EXPECT_LT(interval.low, 0.9);
  EXPECT_GT(interval.high, 0.9);
  const Interval fixed = ClopperPearson(90, 100, 0.95);  // who may stop at any time knows less
  EXPECT_LT(interval.low, fixed.low);
  EXPECT_GT(interval.high, fixed.high);
}

TEST(Requirement, IsReadAsWritten) {
  const Requirement success = ParseRequirement("success >= 0.95 @ 95%");
  EXPECT_FALSE(success.metric);
  EXPECT_DOUBLE_EQ(success.rate.at_least, 0.95);
  EXPECT_DOUBLE_EQ(success.rate.confidence, 0.95);
  const Requirement metric = ParseRequirement("P(ate_online_m<=0.1)>=90% @0.99");
  ASSERT_TRUE(metric.metric);
  EXPECT_EQ(metric.metric->name, "ate_online_m");
  EXPECT_TRUE(metric.metric->at_most);
  EXPECT_DOUBLE_EQ(metric.metric->limit, 0.1);
  EXPECT_DOUBLE_EQ(metric.rate.at_least, 0.9);
  EXPECT_FALSE(ParseRequirement("P(min_clearance_m >= 2e-1) >= 0.9 @ 95%").metric->at_most);
  for (const char* wrong : {"", "success", "success > 0.9 @ 95%", "success >= 0.9", "success >= 1 @ 95%",
                            "success >= 0.9 @ 100%", "success >= 0.9 @ 40%", "success >= 0.9 @ 95% please",
                            "P(ate) >= 0.9 @ 95%", "happiness >= 0.9 @ 95%", "success >= 95 @ 95%"}) {
    EXPECT_THROW(ParseRequirement(wrong), base::InputError) << wrong;
  }
}

}  // namespace
}  // namespace alula::scenarios::statistics
