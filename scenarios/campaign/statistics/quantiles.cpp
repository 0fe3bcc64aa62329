#include "scenarios/campaign/statistics/quantiles.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace alula::scenarios::statistics {

namespace {

constexpr int kResamples = 2000;  // the ends of a 95 % interval then rest on 50 resamples each

/// One draw with replacement, sorted: how often each rank was drawn makes a sort needless.
void Resample(std::span<const double> sorted, base::RandomStream& random, std::vector<int>& times,
              std::vector<double>& resample) {
  std::fill(times.begin(), times.end(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i) ++times[random.Index(sorted.size())];
  resample.clear();
  for (std::size_t i = 0; i < sorted.size(); ++i) resample.insert(resample.end(), times[i], sorted[i]);
}

}  // namespace

double QuantileOfSorted(std::span<const double> sorted, double q) {
  const double rank = static_cast<double>(sorted.size() - 1) * q;
  const auto below = static_cast<std::size_t>(rank);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (rank - std::floor(rank)) * (sorted[below + 1] - sorted[below]);
}

std::vector<QuantileEstimate> Quantiles(std::vector<double> values, std::span<const double> qs, double confidence,
                                        std::uint64_t seed, std::string_view name) {
  if (values.empty()) return {};
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
    throw base::FaultError("not_finite", "quantiles are taken of finite values only");
  }
  std::sort(values.begin(), values.end());

  base::RandomStream random(seed, name);
  std::vector<std::vector<double>> drawn(qs.size());
  std::vector<int> times(values.size());
  std::vector<double> resample;
  resample.reserve(values.size());
  for (int i = 0; i < kResamples; ++i) {
    Resample(values, random, times, resample);
    for (std::size_t k = 0; k < qs.size(); ++k) drawn[k].push_back(QuantileOfSorted(resample, qs[k]));
  }

  std::vector<QuantileEstimate> estimates;
  for (std::size_t k = 0; k < qs.size(); ++k) {
    std::sort(drawn[k].begin(), drawn[k].end());
    const double outside = (1.0 - confidence) / 2.0;
    estimates.push_back({qs[k],
                         QuantileOfSorted(values, qs[k]),
                         {QuantileOfSorted(drawn[k], outside), QuantileOfSorted(drawn[k], 1.0 - outside)}});
  }
  return estimates;
}

std::int64_t RunsToBoundQuantile(double q, double confidence) {
  const double outer = std::max(q, 1.0 - q);
  return static_cast<std::int64_t>(std::ceil(std::log((1.0 - confidence) / 2.0) / std::log(outer)));
}

}  // namespace alula::scenarios::statistics
