#include "scenarios/campaign/statistics/effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {
namespace {

using Numbers = std::vector<double>;
using Words = std::vector<std::string>;

const NumericEffect& Numeric(const Effect& effect) { return std::get<NumericEffect>(effect.detail); }

/// Brute-force twin: the share of all choices of failed runs whose U is as far out, either side, doubled.
double MannWhitneyByChoice(const Numbers& values, const std::vector<bool>& failed) {
  const auto u_of = [&](const std::vector<bool>& chosen) {
    double u = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t j = 0; j < values.size(); ++j) {
        if (chosen[i] && !chosen[j]) u += values[i] > values[j] ? 1.0 : values[i] == values[j] ? 0.5 : 0.0;
      }
    }
    return u;
  };
  const double observed = u_of(failed);
  std::vector<bool> chosen = failed;
  std::sort(chosen.begin(), chosen.end());
  double all = 0.0, lower = 0.0, upper = 0.0;
  do {
    const double u = u_of(chosen);
    all += 1.0;
    lower += u <= observed ? 1.0 : 0.0;
    upper += u >= observed ? 1.0 : 0.0;
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return std::min(1.0, 2.0 * std::min(lower, upper) / all);
}

TEST(Effects, NumbersAgreeWithAllChoices) {
  const std::vector<bool> failed = {true, false, false, true, false, true, false, false, false, true};
  for (const Numbers& values : {Numbers{9, 1, 2, 8, 3, 7, 4, 5, 6, 2.5}, Numbers{3, 1, 1, 2, 3, 3, 2, 1, 1, 2}}) {
    const std::vector<Effect> effects = RankEffects({{"wind", values}}, failed);
    ASSERT_EQ(effects.size(), 1u);
    EXPECT_NEAR(effects[0].p, MannWhitneyByChoice(values, failed), 1e-12);
  }
}

TEST(Effects, SplitAndAuc) {
  const std::vector<bool> failed = {false, false, false, true, false, true, true};
  const std::vector<Effect> effects = RankEffects({{"wind", Numbers{1, 2, 3, 4, 5, 6, 8}}}, failed);
  const NumericEffect& wind = Numeric(effects.at(0));
  EXPECT_NEAR(wind.auc, 11.0 / 12.0, 1e-15);  // of 3 · 4 pairs only (4, 5) stands the other way
  EXPECT_DOUBLE_EQ(wind.split.threshold, 3.5);
  EXPECT_EQ(wind.split.runs_below, 3);
  EXPECT_EQ(wind.split.runs_above, 4);
  EXPECT_DOUBLE_EQ(wind.split.failure_rate_below, 0.0);
  EXPECT_DOUBLE_EQ(wind.split.failure_rate_above, 0.75);
}

TEST(Effects, TeaTasting) {
  // Fisher's lady: 3 of 4 right either way, two-sided p = 34/70.
  const std::vector<bool> failed = {true, true, true, false, true, false, false, false};
  const std::vector<Effect> effects = RankEffects({{"milk", Words{"a", "a", "a", "a", "b", "b", "b", "b"}}}, failed);
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_NEAR(effects[0].p, 34.0 / 70.0, 1e-12);
  const auto& rates = std::get<std::vector<WordRate>>(effects[0].detail);
  EXPECT_EQ(rates[0].word, "a");
  EXPECT_DOUBLE_EQ(rates[0].failure_rate, 0.75);
}

TEST(Effects, ThreeWordsByChiSquare) {
  // 10 runs each, 1, 5 and 9 failures: χ² = 12.8 with two degrees of freedom, p = exp(-6.4).
  Words words;
  std::vector<bool> failed;
  for (const auto& [word, failures] : {std::pair{"day", 1}, {"dusk", 5}, {"night", 9}}) {
    for (int i = 0; i < 10; ++i) {
      words.push_back(word);
      failed.push_back(i < failures);
    }
  }
  const std::vector<Effect> effects = RankEffects({{"light", words}}, failed);
  EXPECT_NEAR(effects.at(0).p, std::exp(-6.4), 1e-12);
  EXPECT_EQ(std::get<std::vector<WordRate>>(effects[0].detail)[0].word, "night");
}

TEST(Effects, TheCauseComesFirst) {
  constexpr int kRuns = 400;
  base::RandomStream random(1, "effects");
  std::vector<ParameterColumn> columns = {{"noise_a", Numbers{}},
                                          {"wind", Numbers{}},
                                          {"noise_b", Numbers{}},
                                          {"fixed", Numbers(kRuns, 1.0)},
                                          {"same", Words(kRuns, "x")}};
  std::vector<bool> failed;
  for (int i = 0; i < kRuns; ++i) {
    for (std::size_t k = 0; k < 3; ++k) std::get<Numbers>(columns[k].values).push_back(random.Uniform());
    const double wind = std::get<Numbers>(columns[1].values).back();
    failed.push_back(random.Uniform() < (wind > 0.8 ? 0.6 : 0.05));
  }
  const std::vector<Effect> effects = RankEffects(columns, failed);
  ASSERT_EQ(effects.size(), 3u);  // what does not vary is left out
  EXPECT_EQ(effects[0].name, "wind");
  EXPECT_LT(effects[0].p_holm, 1e-6);
  EXPECT_NEAR(effects[0].p_holm, 3.0 * effects[0].p, 1e-15);
  EXPECT_NEAR(Numeric(effects[0]).split.threshold, 0.8, 0.03);
  EXPECT_GE(effects[1].p_holm, effects[1].p);
  EXPECT_LE(effects[1].p_holm, effects[2].p_holm);
}

// Where the exact distribution is too long, the normal one takes over: the same data either side of the limit.
TEST(Effects, PValuesAreUniformWithoutAnEffect) {
  for (const int runs : {40, 600}) {
    int small = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      base::RandomStream random(seed, "null");
      Numbers values;
      std::vector<bool> failed;
      for (int i = 0; i < runs; ++i) {
        values.push_back(std::floor(10.0 * random.Uniform()));
        failed.push_back(random.Uniform() < 0.3);
      }
      small += RankEffects({{"x", values}}, failed).at(0).p <= 0.05 ? 1 : 0;
    }
    EXPECT_LE(small, 20 + 3 * 4.4) << runs;  // 5 % of 400 and three standard deviations
    EXPECT_GE(small, 20 - 3 * 4.4) << runs;
  }
}

TEST(Effects, NothingToSeparate) {
  EXPECT_TRUE(RankEffects({{"x", Numbers{1, 2}}}, {true, true}).empty());
  EXPECT_TRUE(RankEffects({{"x", Numbers{1, 2}}}, {false, false}).empty());
  EXPECT_TRUE(RankEffects({{"x", Numbers{1, std::nan("")}}}, {true, false}).empty());
  EXPECT_THROW(RankEffects({{"x", Numbers{1}}}, {true, false}), base::FaultError);
}

}  // namespace
}  // namespace alula::scenarios::statistics
