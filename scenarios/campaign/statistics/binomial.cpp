#include "scenarios/campaign/statistics/binomial.h"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "base/error.h"

namespace alula::scenarios::statistics {

namespace {

void Check(std::int64_t successes, std::int64_t runs, double confidence) {
  if (successes < 0 || runs < successes || !(confidence > 0.0 && confidence < 1.0)) {
    throw base::FaultError("bad_counts", "a binomial interval needs 0 <= successes <= runs and 0 < confidence < 1");
  }
}

}  // namespace

double LowerBound(std::int64_t successes, std::int64_t runs, double confidence) {
  Check(successes, runs, confidence);
  if (successes == 0) return 0.0;
  return boost::math::ibeta_inv(static_cast<double>(successes), static_cast<double>(runs - successes + 1),
                                1.0 - confidence);
}

double UpperBound(std::int64_t successes, std::int64_t runs, double confidence) {
  Check(successes, runs, confidence);
  if (successes == runs) return 1.0;
  return boost::math::ibetac_inv(static_cast<double>(successes + 1), static_cast<double>(runs - successes),
                                 1.0 - confidence);
}

Interval ClopperPearson(std::int64_t successes, std::int64_t runs, double confidence) {
  const double one_sided = 0.5 + confidence / 2.0;
  return {LowerBound(successes, runs, one_sided), UpperBound(successes, runs, one_sided)};
}

double BinomialProbability(std::int64_t successes, std::int64_t runs, double p) {
  if (p <= 0.0) return successes == 0 ? 1.0 : 0.0;
  if (p >= 1.0) return successes == runs ? 1.0 : 0.0;
  const auto s = static_cast<double>(successes), f = static_cast<double>(runs - successes);
  return std::exp(std::lgamma(s + f + 1.0) - std::lgamma(s + 1.0) - std::lgamma(f + 1.0) + s * std::log(p) +
                  f * std::log1p(-p));
}

double ClopperPearsonCoverage(double p, std::int64_t runs, double confidence) {
  double covered = 0.0;
  for (std::int64_t successes = 0; successes <= runs; ++successes) {
    const Interval interval = ClopperPearson(successes, runs, confidence);
    if (interval.low <= p && p <= interval.high) covered += BinomialProbability(successes, runs, p);
  }
  return covered;
}

}  // namespace alula::scenarios::statistics
