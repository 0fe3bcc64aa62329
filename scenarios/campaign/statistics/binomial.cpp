#include "scenarios/campaign/statistics/binomial.h"

#include <boost/math/distributions/binomial.hpp>

namespace alula::scenarios::statistics {
namespace {

using Binomial = boost::math::binomial_distribution<double>;

}  // namespace

double LowerBound(std::int64_t successes, std::int64_t runs, double confidence) {
  if (successes <= 0) return 0.0;
  return Binomial::find_lower_bound_on_p(static_cast<double>(runs), static_cast<double>(successes), 1.0 - confidence);
}

double UpperBound(std::int64_t successes, std::int64_t runs, double confidence) {
  if (successes >= runs) return 1.0;
  return Binomial::find_upper_bound_on_p(static_cast<double>(runs), static_cast<double>(successes), 1.0 - confidence);
}

Interval ClopperPearson(std::int64_t successes, std::int64_t runs, double confidence) {
  const double each = 0.5 + 0.5 * confidence;
  return {LowerBound(successes, runs, each), UpperBound(successes, runs, each)};
}

double ClopperPearsonCoverage(double p, std::int64_t runs, double confidence) {
  const Binomial binomial(static_cast<double>(runs), p);
  double coverage = 0.0;
  for (std::int64_t successes = 0; successes <= runs; ++successes) {
    const Interval interval = ClopperPearson(successes, runs, confidence);
    if (interval.low <= p && p <= interval.high) coverage += boost::math::pdf(binomial, static_cast<double>(successes));
  }
  return coverage;
}

}  // namespace alula::scenarios::statistics
