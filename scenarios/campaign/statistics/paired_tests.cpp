#include "scenarios/campaign/statistics/paired_tests.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

namespace alula::scenarios::statistics {
namespace {

constexpr std::size_t kMostExact = 50;
constexpr std::size_t kMostPairs = 2000;  // differences of which all pairs are looked at
constexpr double kTail = 0.025;           // of the shift's interval

struct Ranked {
  double plus = 0.0;  // sum of the ranks of positive differences
  double tie_term = 0.0;
  bool ties = false;
};

Ranked RankSum(std::vector<double> d) {
  std::sort(d.begin(), d.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Ranked ranked;
  for (std::size_t i = 0; i < d.size();) {
    std::size_t end = i + 1;
    while (end < d.size() && std::abs(d[end]) == std::abs(d[i])) ++end;
    const double rank = 0.5 * static_cast<double>(i + 1 + end);  // the mean of those that tie
    for (std::size_t j = i; j < end; ++j) ranked.plus += d[j] > 0.0 ? rank : 0.0;
    const auto tied = static_cast<double>(end - i);
    ranked.tie_term += tied * tied * tied - tied;
    ranked.ties = ranked.ties || end - i > 1;
    i = end;
  }
  return ranked;
}

/// P(W ≤ w) for w = 0 … n(n+1)/2: sums of subsets of 1 … n, each with probability 2^−n.
std::vector<double> ExactDistribution(std::size_t n) {
  std::vector<double> chance(n * (n + 1) / 2 + 1, 0.0);
  chance[0] = 1.0;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t w = chance.size(); w-- > 0;) chance[w] = 0.5 * (chance[w] + (w >= rank ? chance[w - rank] : 0.0));
  }
  for (std::size_t w = 1; w < chance.size(); ++w) chance[w] += chance[w - 1];
  return chance;
}

/// Means of all pairs of differences (each with itself too), sorted.
std::vector<double> WalshAverages(std::vector<double> d) {
  if (d.size() > kMostPairs) d.resize(kMostPairs);
  std::vector<double> means;
  means.reserve(d.size() * (d.size() + 1) / 2);
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = i; j < d.size(); ++j) means.push_back(0.5 * (d[i] + d[j]));
  }
  std::sort(means.begin(), means.end());
  return means;
}

}  // namespace

McNemar McNemarTest(std::int64_t only_a, std::int64_t only_b) {
  McNemar test{only_a, only_b, 1.0};
  const std::int64_t n = only_a + only_b;
  if (n == 0) return test;
  const boost::math::binomial_distribution<double> fair(static_cast<double>(n), 0.5);
  test.p = std::min(1.0, 2.0 * boost::math::cdf(fair, static_cast<double>(std::min(only_a, only_b))));
  return test;
}

WilcoxonSignedRank WilcoxonTest(std::span<const double> differences) {
  std::vector<double> d;
  std::copy_if(differences.begin(), differences.end(), std::back_inserter(d), [](double x) { return x != 0.0; });
  WilcoxonSignedRank test;
  test.differences = static_cast<std::int64_t>(d.size());
  test.zeros = static_cast<std::int64_t>(differences.size() - d.size());
  if (d.empty()) {
    test.shift_interval = {0.0, 0.0};
    return test;
  }
  const Ranked ranked = RankSum(d);
  const auto n = static_cast<double>(d.size());
  const double total = n * (n + 1.0) / 2.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranked.tie_term / 48.0;
  const double lesser = std::min(ranked.plus, total - ranked.plus);
  const boost::math::normal normal;
  test.exact = d.size() <= kMostExact && !ranked.ties;
  std::size_t outside = 0;  // Walsh averages that lie beyond each end of the interval
  if (test.exact) {
    const std::vector<double> distribution = ExactDistribution(d.size());
    test.p = std::min(1.0, 2.0 * distribution[static_cast<std::size_t>(lesser)]);
    while (distribution[outside] <= kTail) ++outside;
  } else {
    const double z = (lesser + 0.5 - 0.5 * total) / std::sqrt(variance);
    test.p = std::min(1.0, 2.0 * boost::math::cdf(normal, z));
    const double k = 0.5 * total + boost::math::quantile(normal, kTail) * std::sqrt(variance);
    outside = static_cast<std::size_t>(std::max(0.0, std::floor(k)));
  }
  const std::vector<double> means = WalshAverages(std::move(d));
  const std::size_t middle = means.size() / 2;
  test.shift = means.size() % 2 == 1 ? means[middle] : 0.5 * (means[middle - 1] + means[middle]);
  outside = std::min(outside, (means.size() - 1) / 2);
  test.shift_interval = outside == 0 && test.p > 2.0 * kTail
                            ? Interval{means.front(), means.back()}
                            : Interval{means[outside], means[means.size() - 1 - outside]};
  return test;
}

}  // namespace alula::scenarios::statistics
