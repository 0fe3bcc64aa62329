#include "scenarios/campaign/statistics/sequential_test.h"

#include <algorithm>
#include <cmath>

#include "scenarios/campaign/statistics/internal/log_beta.h"

namespace alula::scenarios::statistics {

namespace {

constexpr double kPriorA = 0.5;        // Jeffreys' side, towards the tested rate
constexpr double kLeastPriorB = 0.25;  // smaller: sooner if all pass, later with the first failure
constexpr double kMostPriorB = 50.0;   // without it one failure would never bound a rate away from 1
constexpr int kBisections = 60;        // to the last bits of a double

double PriorB(double rate) { return std::clamp(kPriorA * (1.0 - rate) / rate, kLeastPriorB, kMostPriorB); }

double LogLevel(double confidence) { return -std::log1p(-confidence); }

}  // namespace

double LogEvidenceAbove(double rate, std::int64_t successes, std::int64_t failures) {
  const auto s = static_cast<double>(successes), f = static_cast<double>(failures);
  const double b = PriorB(rate);
  return LogUpperBeta(s + kPriorA, f + b, rate) - LogUpperBeta(kPriorA, b, rate) - s * std::log(rate) -
         f * std::log1p(-rate);
}

double LogEvidenceBelow(double rate, std::int64_t successes, std::int64_t failures) {
  return LogEvidenceAbove(1.0 - rate, failures, successes);
}

double AnytimeLowerBound(std::int64_t successes, std::int64_t failures, double confidence) {
  if (successes == 0) return 0.0;
  // At the observed share no other rate is likelier, so that the evidence there is at most 1: the bound lies below.
  double low = 0.0, high = static_cast<double>(successes) / static_cast<double>(successes + failures);
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (LogEvidenceAbove(middle, successes, failures) >= LogLevel(confidence) ? low : high) = middle;
  }
  return low;
}

double AnytimeUpperBound(std::int64_t successes, std::int64_t failures, double confidence) {
  return 1.0 - AnytimeLowerBound(failures, successes, confidence);
}

Decision SequentialTest::Add(bool success) {
  ++(success ? successes : failures);
  if (decision != Decision::kUndecided) return decision;
  // A pass never lessens the evidence above nor raises the one below, and a failure the other way round.
  const double rate = requirement.at_least, level = LogLevel(requirement.confidence);
  if (success) {
    if (LogEvidenceAbove(rate, successes, failures) >= level) decision = Decision::kConfirmed;
  } else {
    if (LogEvidenceBelow(rate, successes, failures) >= level) decision = Decision::kRejected;
  }
  if (decision != Decision::kUndecided) decided_after = successes + failures;
  return decision;
}

Interval SequentialTest::interval() const {
  const double one_sided = 0.5 + requirement.confidence / 2.0;
  return {AnytimeLowerBound(successes, failures, one_sided), AnytimeUpperBound(successes, failures, one_sided)};
}

std::int64_t RunsIfAllPass(const RateRequirement& requirement) {
  const double level = LogLevel(requirement.confidence);
  const auto confirms = [&](std::int64_t runs) { return LogEvidenceAbove(requirement.at_least, runs, 0) >= level; };
  std::int64_t enough = 1;
  while (!confirms(enough)) enough *= 2;
  std::int64_t too_few = enough / 2;
  while (enough - too_few > 1) {
    const std::int64_t middle = too_few + (enough - too_few) / 2;
    (confirms(middle) ? enough : too_few) = middle;
  }
  return enough;
}

}  // namespace alula::scenarios::statistics
