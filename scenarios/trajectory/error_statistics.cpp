#include "scenarios/trajectory/error_statistics.h"

#include <algorithm>
#include <cmath>

#include "scenarios/campaign/statistics/quantiles.h"

namespace alula::scenarios::trajectory {

Statistics StatisticsOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const double n = static_cast<double>(values.size());
  return {.count = static_cast<std::int64_t>(values.size()),
          .rmse = std::sqrt(squares / n),
          .mean = sum / n,
          .median = statistics::QuantileOfSorted(values, 0.5),
          .p99 = statistics::QuantileOfSorted(values, 0.99),
          .max = values.back()};
}

}  // namespace alula::scenarios::trajectory
