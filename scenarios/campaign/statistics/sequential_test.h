#pragma once

#include <cstdint>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::statistics {

/// "The rate of successes is at least so much", to be known with so much confidence.
struct RateRequirement {
  double at_least = 0.95;
  double confidence = 0.95;
};

enum class Decision { kUndecided, kConfirmed, kRejected };

/// A test of a RateRequirement that may stop whenever it likes: after any number of runs, looked at as often as one
/// pleases, the chance to confirm a rate below the limit, or to reject one at or above it, is at most 1 − confidence.
///
/// The evidence against "the rate is below p₀" is the likelihood ratio of all higher rates, mixed by Jeffreys' prior
/// Beta(½, ½) cut off at p₀:
///   E = ∫_{p₀}^1 p^s (1 − p)^f dπ(p) / (p₀^s (1 − p₀)^f),  s successes and f failures.
/// It is a supermartingale for every rate below p₀, so that it reaches 1/α with a probability of α at most (Ville 1939;
/// Robbins 1970; Howard, Ramdas, McAuliffe and Sekhon 2021). Against "at least p₀" likewise, from the other side.
class SequentialTest {
 public:
  explicit SequentialTest(const RateRequirement& requirement) : requirement_(requirement) {}

  /// One more run. The first decision holds for ever.
  Decision Add(bool success);
  Decision decision() const { return decision_; }
  std::int64_t runs() const { return successes_ + failures_; }

  /// Rates that the runs so far do not exclude at the confidence, valid at any stopping time: those whose two-sided
  /// mixture (the whole of Jeffreys' prior) stayed below 1/α.
  Interval interval() const;

 private:
  RateRequirement requirement_;
  Decision decision_ = Decision::kUndecided;
  std::int64_t successes_ = 0;
  std::int64_t failures_ = 0;
};

/// log E against "the rate is below p₀", and against "the rate is at least p₀".
double LogEvidenceAgainstBelow(double p0, std::int64_t successes, std::int64_t failures);
double LogEvidenceAgainstAtLeast(double p0, std::int64_t successes, std::int64_t failures);

/// The fewest runs that can confirm: all of them successes.
std::int64_t RunsIfAllPass(const RateRequirement& requirement);

}  // namespace alula::scenarios::statistics
