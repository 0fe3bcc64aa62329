#pragma once

#include <cstdint>

namespace alula::scenarios::statistics {

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Two-sided interval of a success rate from a number of runs fixed beforehand (Clopper & Pearson 1934): each side
/// errs with at most (1 - confidence)/2. 60 of 60 at 95 % is [0.9404, 1]. No runs: [0, 1].
/// 0 ≤ successes ≤ runs, 0 < confidence < 1, else FaultError, here and below.
Interval ClopperPearson(std::int64_t successes, std::int64_t runs, double confidence);

/// One-sided: the rate lies at or above it with at least the stated confidence. 60 of 60 at 95 % is 0.9513: a rate
/// that is quoted as "at least" is this one, and it lies above ClopperPearson().low, which shares its error with the
/// other side. No runs: 0.
double LowerBound(std::int64_t successes, std::int64_t runs, double confidence);
/// One-sided: the rate lies at or below it. No runs: 1.
double UpperBound(std::int64_t successes, std::int64_t runs, double confidence);

/// How often ClopperPearson of `runs` runs contains a true rate p, exactly: the sum of the binomial over the numbers of
/// successes whose interval contains p. Never below the confidence.
double ClopperPearsonCoverage(double p, std::int64_t runs, double confidence);

/// Probability of exactly `successes` in `runs` at rate p.
double BinomialProbability(std::int64_t successes, std::int64_t runs, double p);

}  // namespace alula::scenarios::statistics
