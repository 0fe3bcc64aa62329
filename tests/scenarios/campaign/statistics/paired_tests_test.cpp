#include "scenarios/campaign/statistics/paired_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {
namespace {

TEST(McNemar, IsTwiceTheTailOfACoin) {
  // 1 against 9: 2 (1 + 10) / 1024. 3 against 12: 2 (1 + 15 + 105 + 455) / 32768.
  EXPECT_NEAR(McNemar(1, 9).p, 22.0 / 1024.0, 1e-14);
  EXPECT_NEAR(McNemar(12, 3).p, 1152.0 / 32768.0, 1e-14);
  EXPECT_EQ(McNemar(5, 5).p, 1.0);
  EXPECT_EQ(McNemar(0, 0).p, 1.0);
  EXPECT_NEAR(McNemar(0, 6).p, 2.0 / 64.0, 1e-15);
}

/// Brute-force twin: all 2^n signs of the given ranks.
double PBySigns(const std::vector<double>& ranks, double rank_sum) {
  int lower = 0, upper = 0;
  for (unsigned signs = 0; signs < 1u << ranks.size(); ++signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ranks.size(); ++i) sum += signs >> i & 1u ? ranks[i] : 0.0;
    lower += sum <= rank_sum ? 1 : 0;
    upper += sum >= rank_sum ? 1 : 0;
  }
  return std::min(1.0, 2.0 * std::min(lower, upper) / std::exp2(static_cast<double>(ranks.size())));
}

WilcoxonTest OfDifferences(const std::vector<double>& differences) {
  return WilcoxonSignedRank(std::vector<double>(differences.size(), 0.0), differences, 0.95);
}

TEST(Wilcoxon, AgreesWithAllSigns) {
  const WilcoxonTest plain = OfDifferences({1.1, -2.3, 3.7, 4.2, -0.4, 6.5, 7.9, 8.8});
  EXPECT_TRUE(plain.exact);
  EXPECT_EQ(plain.rank_sum, 32.0);  // all but ranks 1 and 3
  EXPECT_DOUBLE_EQ(plain.p, PBySigns({1, 2, 3, 4, 5, 6, 7, 8}, 32.0));

  const WilcoxonTest tied = OfDifferences({1.0, 1.0, -1.0, 2.0, 0.0, 2.0, -3.0, 4.0, 0.0, 5.0});
  EXPECT_EQ(tied.zeros, 2);
  EXPECT_EQ(tied.pairs, 10);
  EXPECT_EQ(tied.rank_sum, 2.0 + 2.0 + 4.5 + 4.5 + 7.0 + 8.0);
  EXPECT_DOUBLE_EQ(tied.p, PBySigns({2, 2, 2, 4.5, 4.5, 6, 7, 8}, tied.rank_sum));
}

// Published: the depression scores of Hollander & Wolfe 1973 (R's help page of wilcox.test), V = 5 the other way round:
// two-sided p = 0.0390625, shift 0.46 and its 95 % interval [0.01, 0.786].
TEST(Wilcoxon, DepressionScores) {
  const std::vector<double> before = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> after = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const WilcoxonTest test = WilcoxonSignedRank(after, before, 0.95);
  EXPECT_EQ(test.rank_sum, 40.0);
  EXPECT_DOUBLE_EQ(test.p, 0.0390625);
  EXPECT_NEAR(test.median_difference, 0.46, 1e-12);
  EXPECT_NEAR(test.interval.low, 0.01, 1e-12);
  EXPECT_NEAR(test.interval.high, 0.786, 1e-12);
}

TEST(Wilcoxon, ManyPairsAreNormal) {
  base::RandomStream random(2, "pairs");
  std::vector<double> differences;
  for (int i = 0; i < 50; ++i) differences.push_back(random.Gaussian() + 0.3);
  const WilcoxonTest exact = OfDifferences(differences);
  differences.push_back(1e-9);  // one more, of the smallest rank
  const WilcoxonTest normal = OfDifferences(differences);
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(normal.exact);
  EXPECT_NEAR(normal.p, exact.p, 0.1 * exact.p);  // both tests of nearly the same data
}

/// Brute-force twin: all means of two differences, sorted.
TEST(Wilcoxon, MedianOfAllMeans) {
  base::RandomStream random(3, "shift");
  for (const std::size_t n : {1, 2, 5, 20, 51, 120}) {
    std::vector<double> differences, means;
    for (std::size_t i = 0; i < n; ++i) differences.push_back(std::round(10.0 * random.Gaussian()) / 4.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) means.push_back(0.5 * differences[i] + 0.5 * differences[j]);
    }
    std::sort(means.begin(), means.end());
    const std::size_t count = means.size();
    const WilcoxonTest test = OfDifferences(differences);
    EXPECT_DOUBLE_EQ(test.median_difference, 0.5 * means[(count - 1) / 2] + 0.5 * means[count / 2]) << n;
    if (n >= 6) {
      EXPECT_TRUE(std::binary_search(means.begin(), means.end(), test.interval.low));
      EXPECT_TRUE(std::binary_search(means.begin(), means.end(), test.interval.high));
    } else {
      EXPECT_TRUE(std::isinf(test.interval.low));  // five pairs or fewer bound nothing at 95 %
    }
  }
}

TEST(Wilcoxon, IntervalCoversTheShift) {
  for (const int n : {15, 80}) {
    int covered = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      base::RandomStream random(seed, "coverage");
      std::vector<double> differences;
      for (int i = 0; i < n; ++i) differences.push_back(0.7 + random.Gaussian());
      const WilcoxonTest test = OfDifferences(differences);
      covered += test.interval.low <= 0.7 && 0.7 <= test.interval.high ? 1 : 0;
    }
    EXPECT_GE(covered, 950 - 3 * 6.9) << n;  // three standard deviations sqrt(1000 · 0.95 · 0.05)
  }
}

TEST(Wilcoxon, NothingToTest) {
  EXPECT_EQ(OfDifferences({}).p, 1.0);
  EXPECT_EQ(OfDifferences({0.0, 0.0}).p, 1.0);
  EXPECT_EQ(OfDifferences({std::nan(""), 1.0}).pairs, 1);
  EXPECT_THROW(WilcoxonSignedRank(std::vector<double>{1.0}, {}, 0.95), base::FaultError);
}

}  // namespace
}  // namespace alula::scenarios::statistics
