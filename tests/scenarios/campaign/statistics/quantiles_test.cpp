#include "scenarios/campaign/statistics/quantiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {
namespace {

constexpr double kQs[] = {0.0, 0.25, 0.5, 0.95, 1.0};

TEST(Quantiles, AreOfTypeSeven) {
  // Rank (n - 1) q of 1, 2, 4, 8: 0.25 at 0.75, 0.5 at 1.5, 0.95 at 2.85.
  const std::vector<QuantileEstimate> estimates = Quantiles({8.0, 1.0, 4.0, 2.0}, kQs, 0.95, 1, "x");
  ASSERT_EQ(estimates.size(), 5u);
  EXPECT_DOUBLE_EQ(estimates[0].value, 1.0);
  EXPECT_DOUBLE_EQ(estimates[1].value, 1.75);
  EXPECT_DOUBLE_EQ(estimates[2].value, 3.0);
  EXPECT_DOUBLE_EQ(estimates[3].value, 7.4);
  EXPECT_DOUBLE_EQ(estimates[4].value, 8.0);
  for (const QuantileEstimate& estimate : estimates) {
    EXPECT_LE(estimate.interval.low, estimate.value);
    EXPECT_GE(estimate.interval.high, estimate.value);
  }
}

TEST(Quantiles, RepeatExactly) {
  const std::vector<double> values = {3.0, 1.0, 2.0, 7.0, 5.0};
  const auto first = Quantiles(values, kQs, 0.9, 1, "x"), second = Quantiles(values, kQs, 0.9, 1, "x");
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].interval.low, second[k].interval.low);
    EXPECT_EQ(first[k].interval.high, second[k].interval.high);
  }
}

TEST(Quantiles, IntervalsCover) {
  constexpr double kMedian[] = {0.5};
  int covered = 0;
  constexpr int kSamples = 200;
  for (std::uint64_t seed = 0; seed < kSamples; ++seed) {
    base::RandomStream random(seed, "sample");
    std::vector<double> values;
    for (int i = 0; i < 100; ++i) values.push_back(random.Gaussian());
    const Interval interval = Quantiles(values, kMedian, 0.95, seed, "x")[0].interval;
    covered += interval.low <= 0.0 && 0.0 <= interval.high ? 1 : 0;
  }
  // The percentile bootstrap of a median is good to a few percent; three standard deviations of 200 at 0.93.
  EXPECT_GE(covered, 0.93 * kSamples - 3.0 * std::sqrt(kSamples * 0.93 * 0.07));
}

TEST(Quantiles, OneValueAndNone) {
  EXPECT_TRUE(Quantiles({}, kQs, 0.95, 1, "x").empty());
  const auto one = Quantiles({2.0}, kQs, 0.95, 1, "x");
  EXPECT_EQ(one[2].value, 2.0);
  EXPECT_EQ(one[2].interval.high, 2.0);
  EXPECT_THROW(Quantiles({1.0, std::nan("")}, kQs, 0.95, 1, "x"), base::FaultError);
}

TEST(Quantiles, RunsToBound) {
  // 0.95^n ≤ 0.025 from n = 72 on; the median needs 0.5^n ≤ 0.025: 6.
  EXPECT_EQ(RunsToBoundQuantile(0.95, 0.95), 72);
  EXPECT_EQ(RunsToBoundQuantile(0.05, 0.95), 72);
  EXPECT_EQ(RunsToBoundQuantile(0.5, 0.95), 6);
}

}  // namespace
}  // namespace alula::scenarios::statistics
