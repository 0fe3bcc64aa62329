#pragma once

#include <cstdint>
#include <span>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::statistics {

/// Two programs on the same seeds: does one succeed more often?
struct McNemarTest {
  std::int64_t only_first = 0;   // seeds on which the first alone succeeded
  std::int64_t only_second = 0;  // … the second alone
  double p = 1.0;                // two-sided, exact
};

/// Exact test of McNemar 1947: seeds on which both end alike say nothing; of the others half should go either way.
McNemarTest McNemar(std::int64_t only_first, std::int64_t only_second);

/// Two programs on the same seeds: does one have the larger values of a metric?
struct WilcoxonTest {
  std::int64_t pairs = 0;  // finite pairs, of which
  std::int64_t zeros = 0;  // equal ones: dropped in the test, kept in the estimate
  double rank_sum = 0.0;   // of the positive differences second - first
  double p = 1.0;          // two-sided
  bool exact = false;
  double median_difference = 0.0;  // second - first, Hodges & Lehmann 1963: median of all means of two differences
  Interval interval;               // of the median difference; infinite where there are too few pairs for any
};

/// Signed-rank test of Wilcoxon 1945 on second - first. Up to 50 differences other than zero: the exact distribution
/// given the ranks, ties included; beyond: normal with corrections for ties and continuity. The interval inverts the
/// test without ties. Pairs with a value that is not finite are left out; spans of different lengths: FaultError.
WilcoxonTest WilcoxonSignedRank(std::span<const double> first, std::span<const double> second, double confidence);

}  // namespace alula::scenarios::statistics
