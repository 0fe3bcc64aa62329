#pragma once

#include <cstdint>
#include <span>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::statistics {

/// McNemar's test (1947), exact: of the pairs that differ, is one side the better more often than a fair coin says?
struct McNemar {
  std::int64_t only_a = 0;  // pairs in which A alone succeeds
  std::int64_t only_b = 0;
  double p = 1.0;  // two-sided
};
McNemar McNemarTest(std::int64_t only_a, std::int64_t only_b);

/// Wilcoxon's signed-rank test (1945) of differences against symmetry about 0. The distribution is exact for up to 50
/// differences without ties, else normal with corrections for ties and continuity. Differences of 0 are set aside.
struct WilcoxonSignedRank {
  std::int64_t differences = 0;  // that are not 0
  std::int64_t zeros = 0;
  double p = 1.0;           // two-sided
  double shift = 0.0;       // Hodges and Lehmann's (1963): the median of the means of all pairs of differences
  Interval shift_interval;  // at 95 %, from the same distribution
  bool exact = true;
};
WilcoxonSignedRank WilcoxonTest(std::span<const double> differences);

}  // namespace alula::scenarios::statistics
