#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::statistics {

struct QuantileEstimate {
  double q = 0.0;
  double value = 0.0;
  Interval interval;
};

/// Quantile q in [0, 1] of values sorted upwards, at least one: linear between order statistics, at rank (n-1) q
/// ("type 7" of Hyndman & Fan 1996, as R, NumPy and spreadsheets compute it).
double QuantileOfSorted(std::span<const double> sorted, double q);

/// Each quantile with its two-sided percentile-bootstrap interval (Efron 1979; 2000 resamples, drawn from `seed` and
/// `name`, and the same ones for every q). Empty where there are no values. Values must be finite: the caller counts
/// others apart (FaultError).
///
/// A resample never exceeds the largest value seen, so that the interval of an outer quantile of few runs is too
/// narrow: see RunsToBoundQuantile.
std::vector<QuantileEstimate> Quantiles(std::vector<double> values, std::span<const double> qs, double confidence,
                                        std::uint64_t seed, std::string_view name);

/// Fewest runs of which the smallest and the largest value bound the q-quantile from both sides at the stated
/// confidence, whatever the distribution: qⁿ and (1-q)ⁿ ≤ (1 - confidence)/2. 0.95 at 95 %: 72. With fewer runs the
/// interval of Quantiles is not to be trusted. 0 < q < 1.
std::int64_t RunsToBoundQuantile(double q, double confidence);

}  // namespace alula::scenarios::statistics
