#include "scenarios/campaign/statistics/internal/ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace alula::scenarios::statistics {

Ranks RankDoubled(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });

  Ranks ranks;
  ranks.twice_rank.resize(values.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks.twice_rank[order[i]] = static_cast<int>(begin + end + 1);
    const auto size = static_cast<double>(end - begin);
    ranks.ties += size * size * size - size;
  }
  return ranks;
}

double TwoSidedNormal(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double TwoSidedExact(std::span<const double> weights, int observed) {
  const auto middle = weights.begin() + observed;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double lower = std::accumulate(weights.begin(), middle + 1, 0.0);
  const double upper = std::accumulate(middle, weights.end(), 0.0);
  return std::min(1.0, 2.0 * std::min(lower, upper) / all);
}

}  // namespace alula::scenarios::statistics
