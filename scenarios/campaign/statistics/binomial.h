#pragma once

#include <cstdint>

namespace alula::scenarios::statistics {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// The two-sided interval of Clopper and Pearson (1934) for the rate of successes in a fixed number of runs: each side
/// is wrong with a probability of (1 − confidence)/2 at most, whatever the rate. No runs: [0, 1].
Interval ClopperPearson(std::int64_t successes, std::int64_t runs, double confidence);

/// The one-sided bounds: the rate lies above (below) with at least this confidence. 60 of 60 at 95 %: 0.951.
double LowerBound(std::int64_t successes, std::int64_t runs, double confidence);
double UpperBound(std::int64_t successes, std::int64_t runs, double confidence);

/// The probability that ClopperPearson's interval holds the true rate p: the sum over all outcomes of `runs`.
double ClopperPearsonCoverage(double p, std::int64_t runs, double confidence);

}  // namespace alula::scenarios::statistics
