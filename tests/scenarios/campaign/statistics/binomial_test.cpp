#include "scenarios/campaign/statistics/binomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace alula::scenarios::statistics {
namespace {

// Clopper & Pearson's definition: at the bound, the tail beyond what was seen has exactly the error's probability.
TEST(Binomial, BoundsSolveTheirDefinition) {
  for (const std::int64_t runs : {1, 7, 40, 300}) {
    for (std::int64_t seen = 0; seen <= runs; seen += std::max<std::int64_t>(1, runs / 9)) {
      double at_least = 0.0, at_most = 0.0;
      const double low = LowerBound(seen, runs, 0.95), high = UpperBound(seen, runs, 0.95);
      for (std::int64_t k = seen; k <= runs; ++k) at_least += BinomialProbability(k, runs, low);
      for (std::int64_t k = 0; k <= seen; ++k) at_most += BinomialProbability(k, runs, high);
      // 1e-10: sums of up to 300 terms whose logarithms come from lgamma.
      if (seen > 0) {
        EXPECT_NEAR(at_least, 0.05, 1e-10) << seen << " of " << runs;
      }
      if (seen < runs) {
        EXPECT_NEAR(at_most, 0.05, 1e-10) << seen << " of " << runs;
      }
    }
  }
}

TEST(Binomial, AllPassedIsAPower) {
  // With no failure the bound is error^(1/n). 59 is the known sample size for 95 % at 95 %.
  EXPECT_NEAR(ClopperPearson(60, 60, 0.95).low, std::pow(0.025, 1.0 / 60.0), 1e-14);
  EXPECT_NEAR(ClopperPearson(60, 60, 0.95).low, 0.9404, 5e-5);
  EXPECT_NEAR(LowerBound(60, 60, 0.95), 0.9513, 5e-5);
  EXPECT_GE(LowerBound(59, 59, 0.95), 0.95);
  EXPECT_LT(LowerBound(58, 58, 0.95), 0.95);
  EXPECT_EQ(ClopperPearson(60, 60, 0.95).high, 1.0);
}

TEST(Binomial, TabulatedIntervals) {
  // 5 of 10 and 1 of 10 at 95 %, as in tables of the exact interval.
  EXPECT_NEAR(ClopperPearson(5, 10, 0.95).low, 0.1871, 5e-5);
  EXPECT_NEAR(ClopperPearson(5, 10, 0.95).high, 0.8129, 5e-5);
  EXPECT_NEAR(ClopperPearson(1, 10, 0.95).low, 0.0025, 5e-5);
  EXPECT_NEAR(ClopperPearson(1, 10, 0.95).high, 0.4450, 5e-5);
}

TEST(Binomial, NoRunsSayNothing) {
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).low, 0.0);
  EXPECT_EQ(ClopperPearson(0, 0, 0.95).high, 1.0);
  EXPECT_EQ(LowerBound(0, 0, 0.95), 0.0);
  EXPECT_EQ(UpperBound(0, 0, 0.95), 1.0);
}

TEST(Binomial, ManyRuns) {
  const Interval interval = ClopperPearson(950000, 1000000, 0.95);
  // Normal limits: ± 1.96 sqrt(0.95 · 0.05 / 1e6) = ± 4.27e-4, to the next order in 1/n.
  EXPECT_NEAR(interval.low, 0.95 - 4.27e-4, 2e-6);
  EXPECT_NEAR(interval.high, 0.95 + 4.27e-4, 2e-6);
}

TEST(Binomial, WrongCountsAreFaults) {
  EXPECT_THROW(ClopperPearson(3, 2, 0.95), base::FaultError);
  EXPECT_THROW(ClopperPearson(-1, 2, 0.95), base::FaultError);
  EXPECT_THROW(ClopperPearson(1, 2, 1.0), base::FaultError);
}

TEST(Binomial, CoverageIsNeverBelowTheConfidence) {
  for (const double p : {0.5, 0.9, 0.99}) {
    double least = 1.0;
    std::int64_t at = 0;
    for (std::int64_t runs = 1; runs <= 200; ++runs) {
      const double coverage = ClopperPearsonCoverage(p, runs, 0.95);
      if (coverage < least) at = runs;
      least = std::min(least, coverage);
    }
    std::printf("p = %.2f: coverage at least %.4f (at %d runs)\n", p, least, static_cast<int>(at));
    EXPECT_GE(least, 0.95) << p;
  }
}

}  // namespace
}  // namespace alula::scenarios::statistics
