#include "scenarios/campaign/statistics/internal/log_beta.h"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>

namespace alula::scenarios::statistics {

namespace {

// Doubles are enough: the last digits of a logarithm of evidence decide nothing, and long doubles take three times as
// long.
using InDoubles = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double kSmallestShare = 1e-250;  // below it the ratio of two integrals comes near the end of the doubles

double LogBeta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

/// ∫₀ˣ tᵃ⁻¹ (1-t)ᵇ⁻¹ dt = xᵃ (1-x)ᵇ / a · Σ Π (a+b+i)/(a+1+i) x (DLMF 8.17.8): all terms are positive, and so far out
/// in the tail each is well below the one before it.
double LogFarTail(double a, double b, double x, double one_minus_x) {
  double term = 1.0, sum = 1.0;
  for (double i = 0.0; term > std::numeric_limits<double>::epsilon() * sum; ++i) {
    term *= (a + b + i) / (a + 1.0 + i) * x;
    sum += term;
  }
  return a * std::log(x) + b * std::log(one_minus_x) - std::log(a) + std::log(sum);
}

}  // namespace

double LogUpperBeta(double a, double b, double x) {
  const double share = boost::math::ibetac(a, b, x, InDoubles());
  if (share > kSmallestShare) return LogBeta(a, b) + std::log(share);
  return LogFarTail(b, a, 1.0 - x, x);
}

double LogLowerBeta(double a, double b, double x) {
  const double share = boost::math::ibeta(a, b, x, InDoubles());
  if (share > kSmallestShare) return LogBeta(a, b) + std::log(share);
  return LogFarTail(a, b, x, 1.0 - x);
}

}  // namespace alula::scenarios::statistics
