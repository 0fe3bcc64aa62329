#pragma once

#include <Eigen/Core>
#include <span>

#include "scenarios/campaign/search/failure_search.h"
#include "scenarios/campaign/search/internal/proposal.h"

namespace alula::scenarios::search {

/// Runs drawn independently from one fixed proposal.
struct FinalSample {
  Proposal proposal;
  Eigen::MatrixXd points;           // [d×n]
  std::span<const double> margins;  // [n]
};

/// Mean of 1(margin ≤ level) φ/q with its standard error.
struct WeightedMean {
  double mean = 0.0;
  double standard_error = 0.0;
  double effective_sample_size = 0.0;
  std::int64_t hits = 0;
};
WeightedMean ProbabilityUpTo(double level, const FinalSample& sample);

/// Interval of a positive mean of skewed weights: normal on the logarithm, mean · exp(± z σ / mean).
statistics::Interval LogNormalInterval(const WeightedMean& mean, double confidence);

/// All of the estimate but the counts of runs and levels. `level` is what the levels reached; `first_bound`
/// bounds the probability from the first level, one-sided at 97.5 %.
FailureEstimate Estimate(const FinalSample& sample, double level, double first_bound);

}  // namespace alula::scenarios::search
