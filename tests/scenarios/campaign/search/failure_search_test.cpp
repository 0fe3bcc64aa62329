#include "scenarios/campaign/search/failure_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "scenarios/campaign/search/internal/final_sample.h"

namespace alula::scenarios::search {
namespace {

using Margin = std::function<double(const std::vector<double>&)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// P(X > β) of a standard normal X: 1e-4, 7e-5, 3e-5 and 1e-2.
constexpr double kBeta1e4 = 3.719016485455709;
constexpr double kBeta7e5 = 3.808167679182106;
constexpr double kBeta3e5 = 4.012810811118472;
constexpr double kBeta1e2 = 2.3263478740408408;

double Tail(double beta) { return std::erfc(beta / std::sqrt(2.0)) / 2.0; }

/// Distance to a plane across the diagonal, so that every parameter has its part.
double Diagonal(const std::vector<double>& u) {
  return std::accumulate(u.begin(), u.end(), 0.0) / std::sqrt(static_cast<double>(u.size()));
}

FailureEstimate Search(const FailureSearchConfig& config, std::size_t dimensions, std::uint64_t seed,
                       const Margin& margin) {
  FailureSearch search(config, dimensions, seed);
  while (!search.done()) {
    std::vector<double> margins;
    for (const std::vector<double>& point : search.Ask()) margins.push_back(margin(point));
    search.Tell(margins);
  }
  return search.estimate();
}

struct Repetitions {
  double mean = 0.0;
  double deviation = 0.0;
  double mean_runs = 0.0;
  double mean_regions = 0.0;
  int covered = 0;
  int trusted = 0;
};

constexpr int kRepetitions = 100;

Repetitions Repeat(std::size_t dimensions, double truth, const Margin& margin) {
  Repetitions result;
  std::vector<double> estimates;
  for (std::uint64_t seed = 1; seed <= kRepetitions; ++seed) {
    const FailureEstimate estimate = Search({}, dimensions, seed, margin);
    estimates.push_back(estimate.probability);
    result.mean += estimate.probability / kRepetitions;
    result.mean_runs += static_cast<double>(estimate.runs) / kRepetitions;
    result.mean_regions += static_cast<double>(estimate.regions.size()) / kRepetitions;
    result.covered += estimate.interval.low <= truth && truth <= estimate.interval.high ? 1 : 0;
    result.trusted += estimate.trusted ? 1 : 0;
  }
  for (const double e : estimates) {
    result.deviation += (e - result.mean) * (e - result.mean) / (kRepetitions - 1.0);
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

/// The three promises: few runs, an honest interval, no bias.
void ExpectKept(const char* name, std::size_t dimensions, double truth, const Margin& margin) {
  const Repetitions r = Repeat(dimensions, truth, margin);
  const double relative = r.deviation / truth;  // of the estimates themselves, not the error that they state
  const double saving = (1.0 - truth) / (truth * relative * relative) / r.mean_runs;
  const double off = (r.mean - truth) / (r.deviation / std::sqrt(static_cast<double>(kRepetitions)));
  std::printf(
      "%-12s d=%2zu  mean/p %.3f (%+.1f standard errors)  spread/p %.3f  covered %d  trusted %d  runs %.0f  "
      "%.0f x fewer\n",
      name, dimensions, r.mean / truth, off, relative, r.covered, r.trusted, r.mean_runs, saving);
  EXPECT_GE(saving, 20.0);
  EXPECT_GE(r.covered, 90);
  EXPECT_LE(std::abs(off), 3.0);
}

class PlantedRegion : public testing::TestWithParam<std::size_t> {};

TEST_P(PlantedRegion, HalfSpace) {
  ExpectKept("half-space", GetParam(), Tail(kBeta1e4), [](const auto& u) { return kBeta1e4 - Diagonal(u); });
}

TEST_P(PlantedRegion, TwoOppositeHalfSpaces) {
  ExpectKept("two regions", GetParam(), Tail(kBeta7e5) + Tail(kBeta3e5),
             [](const auto& u) { return std::min(kBeta7e5 - u[0], kBeta3e5 + u[0]); });
}

INSTANTIATE_TEST_SUITE_P(Dimensions, PlantedRegion, testing::Values(2, 5, 10));

TEST(FailureSearch, CornerOfABox) {
  ExpectKept("corner", 2, Tail(kBeta1e2) * Tail(kBeta1e2),
             [](const auto& u) { return std::max(kBeta1e2 - u[0], kBeta1e2 + u[1]); });
}

TEST(FailureSearch, NamesBothRegions) {
  const FailureEstimate estimate =
      Search({}, 3, 1, [](const auto& u) { return std::min(kBeta7e5 - u[0], kBeta3e5 + u[0]); });
  ASSERT_EQ(estimate.regions.size(), 2u);
  EXPECT_TRUE(estimate.trusted) << estimate.warning;
  // Shares 0.7 and 0.3 within three standard errors of some 100 failures; the mean beyond a plane at β is β + 1/β.
  EXPECT_NEAR(estimate.regions[0].share, 0.7, 0.15);
  EXPECT_NEAR(estimate.regions[0].mean[0], kBeta7e5 + 0.25, 0.1);
  EXPECT_NEAR(estimate.regions[1].mean[0], -kBeta3e5 - 0.24, 0.1);
  // The other parameters do not matter to failing and stay as they are distributed: N(0, 1).
  EXPECT_NEAR(estimate.regions[0].mean[1], 0.0, 0.5);
  EXPECT_NEAR(estimate.regions[0].spread[1], 1.0, 0.3);
  EXPECT_NEAR(estimate.plain_runs,
              (1.0 - estimate.probability) * estimate.probability / std::pow(estimate.standard_error, 2), 1.0);
}

TEST(FailureSearch, SameSeedAndMarginsGiveTheSamePoints) {
  FailureSearch first({}, 4, 9), second({}, 4, 9), other({}, 4, 10);
  EXPECT_NE(first.Ask(), other.Ask());
  while (!first.done()) {
    EXPECT_EQ(first.Ask(), first.Ask());
    ASSERT_EQ(first.Ask(), second.Ask());
    std::vector<double> margins;
    for (const std::vector<double>& u : first.Ask()) margins.push_back(3.0 - u[0]);
    first.Tell(margins);
    second.Tell(margins);
  }
  EXPECT_TRUE(second.done());
  EXPECT_EQ(first.estimate().probability, second.estimate().probability);
}

TEST(FailureSearch, KeepsItsBudget) {
  for (const std::int64_t runs : {800, 1000, 1700, 3000}) {
    FailureSearchConfig config;
    config.max_runs = runs;
    const FailureEstimate estimate = Search(config, 5, 2, [](const auto& u) { return kBeta1e4 - Diagonal(u); });
    EXPECT_LE(estimate.runs, runs);
  }
}

// A crash says -∞ and tells no distance. Failures are common here, so that no guide is needed.
TEST(FailureSearch, CrashesAndPassesWithoutNumbers) {
  const double truth = Tail(1.0);
  const FailureEstimate estimate = Search({}, 2, 1, [](const auto& u) { return u[0] > 1.0 ? -kInfinity : kInfinity; });
  ASSERT_TRUE(estimate.found);
  EXPECT_NEAR(estimate.probability, truth, 4.0 * estimate.standard_error);
}

TEST(FailureSearch, NoisyMarginsCountWithTheirNoise) {
  constexpr double kNoise = 0.3;
  base::RandomStream noise(5, "noise");
  const double truth = Tail(3.0 / std::sqrt(1.0 + kNoise * kNoise));
  const FailureEstimate estimate =
      Search({}, 3, 1, [&](const auto& u) { return 3.0 - u[0] + kNoise * noise.Gaussian(); });
  EXPECT_NEAR(estimate.probability, truth, 4.0 * estimate.standard_error);
}

TEST(FailureSearch, UpperBoundWhereTheBudgetEndsFirst) {
  FailureSearchConfig config;
  config.max_runs = 1200;
  const FailureEstimate estimate = Search(config, 2, 1, [](const auto& u) { return 20.0 - u[0]; });
  EXPECT_FALSE(estimate.found);
  EXPECT_FALSE(estimate.trusted);
  EXPECT_GT(estimate.level, 0.0);
  EXPECT_EQ(estimate.interval.low, 0.0);
  // No failure in 300 runs, half of them nominal: 2 (1 - 0.025^(1/300)) = 0.0244 at most.
  EXPECT_LE(estimate.interval.high, 0.0245);
  EXPECT_FALSE(estimate.bound_from.empty());
}

TEST(FailureSearch, UpperBoundWithoutAnyGuide) {
  const FailureEstimate estimate = Search({}, 2, 1, [](const auto&) { return kInfinity; });
  EXPECT_FALSE(estimate.found);
  EXPECT_GT(estimate.interval.high, 0.0);
  EXPECT_LE(estimate.interval.high, 0.0245);
}

// Over 200 searches of a region that is out of reach. Where the bound is that of the level, it must lie above the
// level's own probability (closed form) in 97.5 %: 195, less three standard deviations of 2.2.
TEST(FailureSearch, UpperBoundHolds) {
  FailureSearchConfig config;
  config.max_runs = 2500;
  constexpr int kSearches = 200;
  int held = 0, from_level = 0;
  for (std::uint64_t seed = 1; seed <= kSearches; ++seed) {
    const FailureEstimate estimate = Search(config, 2, seed, [](const auto& u) { return 8.0 - u[0]; });
    EXPECT_FALSE(estimate.trusted);
    EXPECT_FALSE(estimate.bound_from.empty());
    from_level += estimate.interval.high < 0.01 ? 1 : 0;  // the first level alone says no better than 0.02
    held += estimate.interval.high >= Tail(8.0 - estimate.level) ? 1 : 0;
  }
  std::printf("upper bound: held in %d of %d, from the levels in %d\n", held, kSearches, from_level);
  EXPECT_GE(held, 188);
  EXPECT_EQ(from_level, kSearches);
}

TEST(FailureSearch, FewFailuresAreNotTrusted) {
  FailureSearchConfig config;
  config.max_runs = 800;
  config.min_final_runs = 500;
  const FailureEstimate estimate = Search(config, 2, 3, [](const auto& u) { return 2.9 - u[0]; });
  EXPECT_FALSE(estimate.trusted);
  EXPECT_FALSE(estimate.warning.empty());
}

TEST(FailureSearch, SaysWhatIsWrong) {
  FailureSearchConfig config;
  config.max_runs = 700;
  EXPECT_THROW(FailureSearch(config, 2, 1), base::InputError);
  config = {};
  config.nominal_share = 0.0;
  EXPECT_THROW(FailureSearch(config, 2, 1), base::InputError);
  EXPECT_THROW(FailureSearch({}, 0, 1), base::InputError);

  FailureSearch search({}, 2, 1);
  EXPECT_THROW(search.estimate(), base::FaultError);
  EXPECT_THROW(search.Tell(std::vector<double>{1.0}), base::FaultError);
  EXPECT_THROW(search.Tell(std::vector<double>(search.Ask().size(), std::nan(""))), base::FaultError);
}

}  // namespace
}  // namespace alula::scenarios::search
