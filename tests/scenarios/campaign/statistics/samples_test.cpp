// Quantiles, paired tests, effects and sampling orders, beside brute force and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "scenarios/campaign/statistics/effects.h"
#include "scenarios/campaign/statistics/orders.h"
#include "scenarios/campaign/statistics/paired_tests.h"
#include "scenarios/campaign/statistics/quantiles.h"

namespace alula::scenarios::statistics {
namespace {

TEST(Quantiles, InterpolateAndCover) {
  EXPECT_DOUBLE_EQ(Quantile(std::vector<double>{1, 2, 3, 4}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(Quantile(std::vector<double>{1, 2, 3, 4}, 0.1), 1.3);  // R: quantile(1:4, .1)
  EXPECT_DOUBLE_EQ(Quantile(std::vector<double>{7}, 0.95), 7.0);
  EXPECT_TRUE(Quantiles({}, std::vector<double>{0.5}, 0.95, 1, "none").empty());
  int covered = 0;
  constexpr int kSamples = 200;
  for (int i = 0; i < kSamples; ++i) {
    base::RandomStream stream(static_cast<std::uint64_t>(i), "sample");
    std::vector<double> values(60);
    for (double& value : values) value = stream.Gaussian();
    const auto median = Quantiles(values, std::vector<double>{0.5}, 0.95, 1, "median").front();
    covered += median.interval.low <= 0.0 && 0.0 <= median.interval.high;
  }
  // The percentile bootstrap of a median covers 93 to 97 % at this size; three sigma of 200 samples beside it.
  EXPECT_GE(covered, kSamples * 0.93 - 3 * std::sqrt(kSamples * 0.07 * 0.93));
}

TEST(McNemar, IsAFairCoinOfThePairsThatDiffer) {
  EXPECT_DOUBLE_EQ(McNemarTest(0, 0).p, 1.0);
  EXPECT_DOUBLE_EQ(McNemarTest(0, 5).p, 2.0 / 32.0);
  EXPECT_NEAR(McNemarTest(10, 2).p, 2.0 * (1 + 12 + 66) / 4096.0, 1e-12);
  EXPECT_DOUBLE_EQ(McNemarTest(3, 3).p, 1.0);
}

TEST(Wilcoxon, AgreesWithAllSignsTriedOut) {
  const std::vector<double> d = {1.5, -0.4, 2.2, 3.1, -0.9, 0.7, 4.0, 2.6};
  const WilcoxonSignedRank test = WilcoxonTest(d);
  std::vector<double> sizes;
  for (const double x : d) sizes.push_back(std::abs(x));
  std::sort(sizes.begin(), sizes.end());
  const auto rank = [&](double x) {
    return static_cast<double>(std::find(sizes.begin(), sizes.end(), std::abs(x)) - sizes.begin()) + 1.0;
  };
  double minus = 0.0;
  for (const double x : d) minus += x < 0.0 ? rank(x) : 0.0;
  int as_extreme = 0;
  for (int signs = 0; signs < 256; ++signs) {
    double sum = 0.0;
    for (int i = 0; i < 8; ++i) sum += (signs >> i) & 1 ? i + 1.0 : 0.0;
    as_extreme += sum <= minus;
  }
  EXPECT_TRUE(test.exact);
  EXPECT_NEAR(test.p, 2.0 * as_extreme / 256.0, 1e-12);
  EXPECT_GT(test.shift, 0.0);
  EXPECT_LT(test.shift_interval.low, test.shift);
  EXPECT_GT(test.shift_interval.high, test.shift);
  EXPECT_DOUBLE_EQ(WilcoxonTest(std::vector<double>{0.0, 0.0}).p, 1.0);
}

TEST(Wilcoxon, NormalFormHoldsItsLevelAndSeesAShift) {
  int wrong = 0, missed = 0;
  constexpr int kSamples = 400;
  for (int i = 0; i < kSamples; ++i) {
    base::RandomStream stream(static_cast<std::uint64_t>(i), "pairs");
    std::vector<double> none(80), shifted(80);
    for (double& value : none) value = std::round(10.0 * stream.Gaussian());  // with ties
    for (double& value : shifted) value = std::round(10.0 * (stream.Gaussian() + 0.8));
    wrong += WilcoxonTest(none).p < 0.05;
    missed += WilcoxonTest(shifted).p >= 0.05;
  }
  EXPECT_LE(wrong, kSamples * 0.05 + 3 * std::sqrt(kSamples * 0.05 * 0.95));
  EXPECT_EQ(missed, 0);
}

TEST(Effects, FindTheParameterThatFails) {
  base::RandomStream stream(3, "effects");
  Column mass{"mass", {}, {}}, noise{"noise", {}, {}}, same{"same", {}, {}}, mode{"mode", {}, {}};
  std::vector<bool> failed;
  for (int i = 0; i < 100; ++i) {
    mass.numbers.push_back(stream.Uniform());
    noise.numbers.push_back(stream.Uniform());
    same.numbers.push_back(1.0);
    mode.words.push_back(i % 3 == 0 ? "slow" : "fast");
    failed.push_back(mass.numbers.back() > 0.9);
  }
  const std::vector<Effect> effects = RankEffects({noise, same, mass, mode}, failed);
  ASSERT_EQ(effects.size(), 3U) << "what does not vary is left out";
  EXPECT_EQ(effects[0].name, "mass");
  EXPECT_DOUBLE_EQ(effects[0].auc, 1.0);
  EXPECT_LT(effects[0].p_holm, 1e-4);
  ASSERT_EQ(effects[0].shares.size(), 2U);
  EXPECT_EQ(effects[0].shares[0].failures, 0);
  EXPECT_EQ(effects[0].shares[1].failures, effects[0].shares[1].runs);
  EXPECT_GT(effects[1].p_holm, 0.05);
  EXPECT_TRUE(RankEffects({mass}, std::vector<bool>(100, false)).empty());
}

TEST(Effects, WordsByFishersTest) {
  Column mode{"mode", {}, {"a", "a", "a", "a", "b", "b", "b", "b"}};
  const std::vector<Effect> effects = RankEffects({mode}, {true, true, true, true, false, false, false, false});
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_NEAR(effects[0].p, 2.0 * 2.0 / 70.0, 1e-9);  // 8 over 4, both extremes, two words
  EXPECT_EQ(effects[0].shares[0].label, "a");
  EXPECT_EQ(effects[0].shares[0].failures, 4);
}

TEST(Orders, LatinHypercubeHasOnePointASlice) {
  const auto points = LatinHypercube(17, 5, 1);
  for (std::size_t d = 0; d < 5; ++d) {
    std::set<int> slices;
    for (const auto& point : points) slices.insert(static_cast<int>(point[d] * 17.0));
    EXPECT_EQ(slices.size(), 17U);
  }
  EXPECT_EQ(points, LatinHypercube(17, 5, 1));
}

TEST(Orders, SobolIsBalancedAndGrows) {
  const auto points = SobolPoints(0, 64, 6, 1);
  for (std::size_t d = 0; d < 6; ++d) {
    std::vector<int> cells(64);
    for (const auto& point : points) ++cells[static_cast<std::size_t>(point[d] * 64.0)];
    EXPECT_EQ(cells, std::vector<int>(64, 1)) << d;
  }
  std::vector<int> squares(64);  // the first two dimensions are a (0, 2) sequence: one point in each 8 × 8 cell
  for (const auto& p : points)
    ++squares[static_cast<std::size_t>(p[0] * 8.0) * 8 + static_cast<std::size_t>(p[1] * 8.0)];
  EXPECT_EQ(squares, std::vector<int>(64, 1));
  const auto more = SobolPoints(0, 100, 6, 1);
  EXPECT_TRUE(std::equal(points.begin(), points.end(), more.begin()));
  EXPECT_EQ(SobolPoints(60, 10, 6, 1).front(), more[60]);
  EXPECT_THROW(SobolPoints(0, 1, 5000, 1), base::InputError);
}

}  // namespace
}  // namespace alula::scenarios::statistics
