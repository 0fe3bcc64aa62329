// The failure search on planted regions whose probability is known in closed form.
#include "scenarios/campaign/search/failure_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

namespace alula::scenarios::search {
namespace {

using Margin = std::function<double(const Point&)>;

double Above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

/// z with P(x > z) = p, by bisection.
double Quantile(double p) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (Above(middle) > p ? low : high) = middle;
  }
  return low;
}

FailureEstimate Search(const Margin& margin, std::size_t dimensions, std::uint64_t seed, FailureSearchConfig config) {
  FailureSearch search(config, dimensions, seed);
  while (!search.done()) {
    std::vector<double> margins;
    for (const Point& point : search.Ask()) margins.push_back(margin(point));
    search.Tell(margins);
  }
  return search.estimate();
}

/// 100 searches: how often the stated interval holds the truth, whether the mean does, and how many runs plain sampling
/// needs for the error that the searches really had (p (1 − p) over their mean squared error).
void Check(const char* name, const Margin& margin, std::size_t dimensions, double truth) {
  constexpr int kSearches = 100;
  int found = 0, inside = 0;
  double sum = 0.0, squares = 0.0, squared_errors = 0.0;
  std::int64_t runs = 0;
  for (int i = 0; i < kSearches; ++i) {
    const FailureEstimate e = Search(margin, dimensions, static_cast<std::uint64_t>(i + 1), {.max_runs = 5000});
    found += e.found;
    inside += e.interval.low <= truth && truth <= e.interval.high;
    sum += e.probability;
    squares += e.probability * e.probability;
    squared_errors += (e.probability - truth) * (e.probability - truth);
    runs += e.runs;
  }
  const double mean = sum / kSearches;
  const double error = std::sqrt((squares / kSearches - mean * mean) / (kSearches - 1));
  const double plain_runs = truth * (1.0 - truth) / (squared_errors / kSearches);
  const double fewer = plain_runs * kSearches / static_cast<double>(runs);
  std::printf("%-18s inside %d of 100, mean %.3g of %.3g (%.1f sigma), %lld runs instead of %.2g: %.0f times fewer\n",
              name, inside, mean, truth, (mean - truth) / error, static_cast<long long>(runs / kSearches), plain_runs,
              fewer);
  EXPECT_EQ(found, kSearches) << name;
  EXPECT_GE(inside, 90) << name;
  EXPECT_LE(std::abs(mean - truth), 3.0 * error) << name;
  EXPECT_GE(fewer, 20.0) << name;
}

TEST(FailureSearch, FindsAHalfSpace) {
  const double b = Quantile(1e-4);
  for (const std::size_t d : {2U, 5U, 10U}) {
    const double scale = std::sqrt(static_cast<double>(d));
    Check(("half-space, " + std::to_string(d)).c_str(), [=](const Point& u) { return b - u.sum() / scale; }, d, 1e-4);
  }
}

TEST(FailureSearch, FindsACorner) {
  // Two parameters must be off together; the others do not matter.
  const double b = Quantile(1e-2);
  for (const std::size_t d : {2U, 5U}) {
    Check(("corner, " + std::to_string(d)).c_str(), [=](const Point& u) { return std::max(b - u[0], b - u[1]); }, d,
          1e-4);
  }
}

TEST(FailureSearch, FindsTwoRegions) {
  const double b = Quantile(0.5e-4);
  for (const std::size_t d : {2U, 5U}) {
    Check(("two sides, " + std::to_string(d)).c_str(), [=](const Point& u) { return b - std::abs(u[0]); }, d, 1e-4);
  }
}

TEST(FailureSearch, StepsAndCrashesAreMargins) {
  // What tells little on the way: margins in steps, failures as crashes.
  const double b = Quantile(1e-3);
  Check(
      "steps",
      [=](const Point& u) {
        return u[0] > b ? -std::numeric_limits<double>::infinity() : std::ceil(4.0 * (b - u[0])) / 4.0;
      },
      3, 1e-3);
}

TEST(FailureSearch, FrequentFailuresNeedNoLevels) {
  const FailureEstimate e = Search([](const Point& u) { return u[0]; }, 2, 1, {.max_runs = 2000});
  EXPECT_TRUE(e.found);
  EXPECT_EQ(e.levels, 1);
  EXPECT_LE(e.interval.low, 0.5);
  EXPECT_GE(e.interval.high, 0.5);
}

TEST(FailureSearch, SaysABoundWhereNothingFails) {
  const FailureEstimate e = Search([](const Point& u) { return 100.0 + u[0]; }, 2, 1, {.max_runs = 1000});
  EXPECT_FALSE(e.found);
  EXPECT_EQ(e.interval.low, 0.0);
  EXPECT_NEAR(e.interval.high, 1.0 - std::pow(0.05, 1.0 / 125), 1e-9);  // no failure in the 125 plain runs
  EXPECT_FALSE(e.warning.empty());
  EXPECT_LE(e.runs, 1000);
}

TEST(FailureSearch, IsTheSameFromTheSameSeed) {
  const Margin margin = [](const Point& u) { return 3.0 - u[0]; };
  const FailureEstimate a = Search(margin, 3, 5, {}), b = Search(margin, 3, 5, {}), c = Search(margin, 3, 6, {});
  EXPECT_EQ(a.probability, b.probability);
  EXPECT_NE(a.probability, c.probability);
}

TEST(FailureSearch, NamesTheRegions) {
  const double b = Quantile(0.5e-3);
  const FailureEstimate e = Search([=](const Point& u) { return b - std::abs(u[0]); }, 2, 1, {});
  double right = 0.0, all = 0.0;
  for (const FailureEstimate::Region& region : e.regions) {
    EXPECT_GT(std::abs(region.mean[0]), b - 0.3);
    right += region.mean[0] > 0.0 ? region.share : 0.0;
    all += region.share;
  }
  EXPECT_NEAR(all, 1.0, 1e-9);
  EXPECT_NEAR(right, 0.5, 0.15);
}

}  // namespace
}  // namespace alula::scenarios::search
