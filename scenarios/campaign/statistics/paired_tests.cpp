#include "scenarios/campaign/statistics/paired_tests.h"

#include <algorithm>
#include <bit>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "scenarios/campaign/statistics/internal/ranks.h"

namespace alula::scenarios::statistics {

namespace {

constexpr std::size_t kMaxExact = 50;  // 2^50 sign patterns are still counted exactly in a double

/// counts[s]: sign patterns whose positive ranks sum to s, of the given (doubled) ranks.
std::vector<double> RankSumCounts(std::span<const int> ranks) {
  std::vector<double> counts = {1.0};
  for (const int rank : ranks) {
    counts.resize(counts.size() + static_cast<std::size_t>(rank), 0.0);
    for (std::size_t s = counts.size(); s-- > static_cast<std::size_t>(rank);) {
      counts[s] += counts[s - static_cast<std::size_t>(rank)];
    }
  }
  return counts;
}

void TestRanks(std::span<const double> nonzero, WilcoxonTest& test) {
  std::vector<double> sizes(nonzero.size());
  std::transform(nonzero.begin(), nonzero.end(), sizes.begin(), [](double d) { return std::abs(d); });
  const Ranks ranks = RankDoubled(sizes);
  int twice_sum = 0;
  for (std::size_t i = 0; i < nonzero.size(); ++i) twice_sum += nonzero[i] > 0.0 ? ranks.twice_rank[i] : 0;
  test.rank_sum = twice_sum / 2.0;
  test.exact = nonzero.size() <= kMaxExact;
  if (test.exact) {
    test.p = TwoSidedExact(RankSumCounts(ranks.twice_rank), twice_sum);
    return;
  }
  const auto n = static_cast<double>(nonzero.size());
  const double off = std::abs(test.rank_sum - n * (n + 1.0) / 4.0) - 0.5;  // 0.5: continuity
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranks.ties / 48.0;
  test.p = off <= 0.0 ? 1.0 : TwoSidedNormal(off / std::sqrt(variance));
}

/// How many means of two of the sorted differences (each with itself too) are at most `limit`, in one pass.
std::int64_t MeansUpTo(std::span<const double> sorted, double limit) {
  std::int64_t count = 0;
  std::size_t partners = sorted.size();
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    while (partners > i && 0.5 * sorted[i] + 0.5 * sorted[partners - 1] > limit) --partners;
    if (partners <= i) break;
    count += static_cast<std::int64_t>(partners - i);
  }
  return count;
}

/// Doubles as whole numbers in the same order, so that bisection ends at one double.
std::int64_t Ordered(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}
double FromOrdered(std::int64_t ordered) {
  return std::bit_cast<double>(ordered < 0 ? std::numeric_limits<std::int64_t>::min() - ordered : ordered);
}

/// The k-th smallest mean of two differences, k from 1, without writing down all n(n+1)/2 of them.
double KthMean(std::span<const double> sorted, std::int64_t k) {
  std::int64_t low = Ordered(sorted.front()), high = Ordered(sorted.back());
  while (low < high) {
    const std::int64_t middle = low + static_cast<std::int64_t>((static_cast<std::uint64_t>(high) - low) / 2);
    if (MeansUpTo(sorted, FromOrdered(middle)) >= k) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return FromOrdered(low);
}

/// The largest k with P(rank sum < k) ≤ tail: the k-th mean from either end bounds the shift. 0: none does.
std::int64_t BoundingRank(std::size_t pairs, double tail) {
  const auto n = static_cast<double>(pairs);
  if (pairs > kMaxExact) {
    const double z = std::sqrt(2.0) * boost::math::erfc_inv(2.0 * tail);
    const double spread = std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
    return static_cast<std::int64_t>(std::floor(n * (n + 1.0) / 4.0 + 0.5 - z * spread));
  }
  std::vector<int> ranks(pairs);
  for (std::size_t i = 0; i < pairs; ++i) ranks[i] = static_cast<int>(i + 1);
  const std::vector<double> counts = RankSumCounts(ranks);
  double below = 0.0;
  std::int64_t k = 0;
  while ((below += counts[static_cast<std::size_t>(k)]) <= tail * std::exp2(n)) ++k;
  return k;
}

void EstimateShift(std::vector<double> differences, double confidence, WilcoxonTest& test) {
  std::sort(differences.begin(), differences.end());
  const auto n = static_cast<std::int64_t>(differences.size());
  const std::int64_t means = n * (n + 1) / 2;
  test.median_difference = 0.5 * KthMean(differences, (means + 1) / 2) + 0.5 * KthMean(differences, means / 2 + 1);
  const std::int64_t k = BoundingRank(differences.size(), (1.0 - confidence) / 2.0);
  if (k > 0) test.interval = {KthMean(differences, k), KthMean(differences, means + 1 - k)};
}

}  // namespace

McNemarTest McNemar(std::int64_t only_first, std::int64_t only_second) {
  McNemarTest test{only_first, only_second, 1.0};
  const auto fewer = static_cast<double>(std::min(only_first, only_second));
  const auto more = static_cast<double>(std::max(only_first, only_second));
  if (fewer < more) test.p = std::min(1.0, 2.0 * boost::math::ibetac(fewer + 1.0, more, 0.5));
  return test;
}

WilcoxonTest WilcoxonSignedRank(std::span<const double> first, std::span<const double> second, double confidence) {
  if (first.size() != second.size()) throw base::FaultError("unpaired", "a paired test needs pairs");
  std::vector<double> differences, nonzero;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(second[i])) continue;
    differences.push_back(second[i] - first[i]);
    if (differences.back() != 0.0) nonzero.push_back(differences.back());
  }
  WilcoxonTest test;
  test.pairs = static_cast<std::int64_t>(differences.size());
  test.zeros = test.pairs - static_cast<std::int64_t>(nonzero.size());
  test.interval = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  TestRanks(nonzero, test);
  if (!differences.empty()) EstimateShift(std::move(differences), confidence, test);
  return test;
}

}  // namespace alula::scenarios::statistics
