#include "scenarios/campaign/statistics/sequential_test.h"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>

namespace alula::scenarios::statistics {
namespace {

constexpr double kPrior = 0.5;  // both parameters of Jeffreys' Beta

double LogBeta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

/// log of the likelihood of rate p, 0 log 0 = 0.
double LogLikelihood(double p, double successes, double failures) {
  const double s = successes > 0.0 ? successes * std::log(p) : 0.0;
  return s + (failures > 0.0 ? failures * std::log1p(-p) : 0.0);
}

/// log ∫ p^s (1−p)^f dπ(p) over one side of p₀, π being the prior cut off there. A side that holds less than a double
/// can tell gives −∞: no evidence.
double LogMixture(double p0, double successes, double failures, bool above) {
  const double a = kPrior + successes, b = kPrior + failures;
  const auto share = [&](double x, double y) {
    return above ? boost::math::ibetac(x, y, p0) : boost::math::ibeta(x, y, p0);
  };
  return LogBeta(a, b) + std::log(share(a, b)) - LogBeta(kPrior, kPrior) - std::log(share(kPrior, kPrior));
}

}  // namespace

double LogEvidenceAgainstBelow(double p0, std::int64_t successes, std::int64_t failures) {
  const auto s = static_cast<double>(successes), f = static_cast<double>(failures);
  return LogMixture(p0, s, f, true) - LogLikelihood(p0, s, f);
}

double LogEvidenceAgainstAtLeast(double p0, std::int64_t successes, std::int64_t failures) {
  const auto s = static_cast<double>(successes), f = static_cast<double>(failures);
  return LogMixture(p0, s, f, false) - LogLikelihood(p0, s, f);
}

Decision SequentialTest::Add(bool success) {
  ++(success ? successes_ : failures_);
  if (decision_ != Decision::kUndecided) return decision_;
  const double enough = -std::log1p(-requirement_.confidence);
  const double p0 = requirement_.at_least;
  // Runs that lie on one side of the limit are no evidence for the other: there no likelihood ratio exceeds 1.
  if (static_cast<double>(successes_) > p0 * static_cast<double>(runs())) {
    if (LogEvidenceAgainstBelow(p0, successes_, failures_) >= enough) decision_ = Decision::kConfirmed;
  } else if (LogEvidenceAgainstAtLeast(p0, successes_, failures_) >= enough) {
    decision_ = Decision::kRejected;
  }
  return decision_;
}

Interval SequentialTest::interval() const {
  if (runs() == 0) return {0.0, 1.0};
  const auto s = static_cast<double>(successes_), f = static_cast<double>(failures_);
  const double mixture = LogBeta(kPrior + s, kPrior + f) - LogBeta(kPrior, kPrior);
  const double enough = -std::log1p(-requirement_.confidence);
  const auto excluded = [&](double p) { return mixture - LogLikelihood(p, s, f) >= enough; };
  const double best = s / (s + f);
  // The likelihood falls to both sides of its largest value, so each end is found by bisection.
  const auto end = [&](double outside) {
    double inside = best;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (excluded(middle) ? outside : inside) = middle;
    }
    return inside;
  };
  return {successes_ == 0 ? 0.0 : end(0.0), failures_ == 0 ? 1.0 : end(1.0)};
}

std::int64_t RunsIfAllPass(const RateRequirement& requirement) {
  const double enough = -std::log1p(-requirement.confidence);
  std::int64_t least = 0, most = 1;
  while (LogEvidenceAgainstBelow(requirement.at_least, most, 0) < enough) {
    least = most;
    most *= 2;
  }
  while (most - least > 1) {
    const std::int64_t middle = least + (most - least) / 2;
    (LogEvidenceAgainstBelow(requirement.at_least, middle, 0) < enough ? least : most) = middle;
  }
  return most;
}

}  // namespace alula::scenarios::statistics
