#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace alula::scenarios::trajectory {

/// Of a list of sizes (errors, times). Without any all are infinite: what was not measured keeps no limit.
struct Statistics {
  std::int64_t count = 0;
  double rmse = std::numeric_limits<double>::infinity();  // √(mean of squares)
  double mean = rmse, median = rmse, p99 = rmse, max = rmse;
};

/// Quantiles are linear between order statistics (QuantileOfSorted).
Statistics StatisticsOf(std::vector<double> values);

}  // namespace alula::scenarios::trajectory
