#include "scenarios/campaign/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/random.h"

namespace alula::scenarios::statistics {
namespace {

constexpr std::size_t kResamples = 2000;

}  // namespace

double Quantile(std::span<const double> sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<QuantileEstimate> Quantiles(std::vector<double> values, std::span<const double> qs, double confidence,
                                        std::uint64_t seed, std::string_view name) {
  std::vector<QuantileEstimate> estimates;
  if (values.empty()) return estimates;
  std::sort(values.begin(), values.end());
  base::RandomStream stream(seed, "bootstrap/" + std::string(name));
  std::vector<std::vector<double>> spread(qs.size());
  std::vector<double> resample(values.size());
  std::vector<std::size_t> counts(values.size());
  for (std::size_t i = 0; i < kResamples; ++i) {
    std::fill(counts.begin(), counts.end(), 0);  // counting keeps the resample sorted
    for (std::size_t j = 0; j < values.size(); ++j) ++counts[stream.Index(values.size())];
    auto out = resample.begin();
    for (std::size_t j = 0; j < values.size(); ++j) out = std::fill_n(out, counts[j], values[j]);
    for (std::size_t k = 0; k < qs.size(); ++k) spread[k].push_back(Quantile(resample, qs[k]));
  }
  for (std::size_t k = 0; k < qs.size(); ++k) {
    std::sort(spread[k].begin(), spread[k].end());
    const double tail = 0.5 * (1.0 - confidence);
    estimates.push_back({qs[k], Quantile(values, qs[k]), {Quantile(spread[k], tail), Quantile(spread[k], 1.0 - tail)}});
  }
  return estimates;
}

}  // namespace alula::scenarios::statistics
