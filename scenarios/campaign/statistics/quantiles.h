#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::statistics {

struct QuantileEstimate {
  double q = 0.5;
  double value = 0.0;
  Interval interval;
};

/// The q-quantile of a sorted sample by linear interpolation between its values (Hyndman and Fan 1996, type 7).
double Quantile(std::span<const double> sorted, double q);

/// Quantiles of a sample with percentile bootstrap intervals (Efron 1979; 2000 resamples drawn from the stream
/// "bootstrap/<name>"). Values are finite; of none, nothing is given.
std::vector<QuantileEstimate> Quantiles(std::vector<double> values, std::span<const double> qs, double confidence,
                                        std::uint64_t seed, std::string_view name);

}  // namespace alula::scenarios::statistics
