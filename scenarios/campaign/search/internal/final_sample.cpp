#include "scenarios/campaign/search/internal/final_sample.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <string>

namespace alula::scenarios::search {

namespace {

constexpr double kConfidence = 0.95;
constexpr double kLeastEffectiveSize = 50.0;  // below it the standard error itself is known to no better than 10–20 %
constexpr double kMostOutside = 0.3;          // of the probability, found apart from the fitted regions
constexpr double kMostSingleShare = 0.1;      // of the probability, by one run alone

/// [n] φ/q of runs with a margin up to `level`, 0 for the others.
Eigen::VectorXd Weights(double level, const FinalSample& sample) {
  Eigen::VectorXd weights = (LogNominal(sample.points) - LogDensities(sample.proposal, sample.points)).array().exp();
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (!(sample.margins[static_cast<std::size_t>(i)] <= level)) weights[i] = 0.0;
  }
  return weights;
}

/// Each failure belongs to the fitted component that most likely drew it.
std::vector<FailureRegion> Regions(const FinalSample& sample, const Eigen::VectorXd& weights) {
  const Eigen::Index d = sample.points.rows();
  const Eigen::MatrixXd origins = LogComponentDensities(sample.proposal.fitted, sample.points);
  std::vector<FailureRegion> regions;
  for (Eigen::Index k = 0; k < origins.rows(); ++k) {
    Eigen::VectorXd own = weights;
    FailureRegion region;
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      Eigen::Index likeliest = 0;
      origins.col(i).maxCoeff(&likeliest);
      if (likeliest != k) own[i] = 0.0;
      region.failures += own[i] > 0.0 ? 1 : 0;
    }
    if (region.failures == 0) continue;
    region.share = own.sum() / weights.sum();
    const Eigen::VectorXd mean = sample.points * own / own.sum();
    const Eigen::MatrixXd off = sample.points.colwise() - mean;
    const Eigen::VectorXd spread = (off.array().square().matrix() * own / own.sum()).array().sqrt();
    region.mean.assign(mean.data(), mean.data() + d);
    region.spread.assign(spread.data(), spread.data() + d);
    regions.push_back(std::move(region));
  }
  std::stable_sort(regions.begin(), regions.end(),
                   [](const FailureRegion& a, const FailureRegion& b) { return a.share > b.share; });
  return regions;
}

std::string Percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

/// Why the standard error is not to be trusted; empty when it is.
std::string Warning(const FinalSample& sample, const Eigen::VectorXd& weights, const WeightedMean& failures) {
  if (failures.effective_sample_size < kLeastEffectiveSize) {
    return "the failures count as " + std::to_string(std::lround(failures.effective_sample_size)) +
           " equally weighted ones, at least " + std::to_string(std::lround(kLeastEffectiveSize)) +
           " are needed: give more runs";
  }
  const double largest = weights.maxCoeff() / weights.sum();
  if (largest > kMostSingleShare) return "one run alone makes " + Percent(largest) + " of the estimate";
  const double outside = GuardShares(sample.proposal, sample.points).dot(weights) / weights.sum();
  if (outside > kMostOutside) {
    return Percent(outside) +
           " of the estimate lies apart from the failure regions that the levels found: give more "
           "runs a level";
  }
  return {};
}

/// [0, upper bound]: the smaller of two, each wrong with half of what 95 % leaves.
void SetBound(const FinalSample& sample, double level, double first_bound, FailureEstimate& estimate) {
  estimate.interval = {0.0, first_bound};
  estimate.bound_from = "95 % upper limit from how many runs of the first level failed";
  if (!std::isfinite(level)) return;
  const WeightedMean reached = ProbabilityUpTo(level, sample);
  if (reached.hits == 0) return;
  const double level_bound = LogNormalInterval(reached, kConfidence).high;
  if (level_bound >= first_bound) return;
  estimate.interval.high = level_bound;
  estimate.bound_from = "95 % upper limit of the probability of a margin up to " + std::to_string(level) +
                        ", the last level reached, which contains all failures";
}

}  // namespace

WeightedMean ProbabilityUpTo(double level, const FinalSample& sample) {
  const Eigen::VectorXd weights = Weights(level, sample);
  const auto n = static_cast<double>(weights.size());
  WeightedMean result;
  result.mean = weights.sum() / n;
  const double variance = (weights.array() - result.mean).square().sum() / (n - 1.0);
  result.standard_error = std::sqrt(variance / n);
  result.effective_sample_size = EffectiveSampleSize(weights);
  result.hits = (weights.array() > 0.0).count();
  return result;
}

statistics::Interval LogNormalInterval(const WeightedMean& mean, double confidence) {
  const double z = std::sqrt(2.0) * boost::math::erfc_inv(1.0 - confidence);
  const double factor = std::exp(z * mean.standard_error / mean.mean);
  return {mean.mean / factor, mean.mean * factor};
}

FailureEstimate Estimate(const FinalSample& sample, double level, double first_bound) {
  FailureEstimate estimate;
  estimate.level = level;
  estimate.final_runs = sample.points.cols();
  const WeightedMean failures = ProbabilityUpTo(0.0, sample);
  estimate.failures = failures.hits;
  estimate.found = failures.hits > 0;
  estimate.effective_sample_size = failures.effective_sample_size;
  if (!estimate.found) {
    SetBound(sample, level, first_bound, estimate);
    estimate.warning = "no failure was seen in the final sample: an upper bound only";
    return estimate;
  }
  const double relative = failures.standard_error / failures.mean;
  estimate.probability = failures.mean;
  estimate.standard_error = failures.standard_error;
  estimate.interval = LogNormalInterval(failures, kConfidence);
  estimate.interval.high = std::min(1.0, estimate.interval.high);
  estimate.plain_runs = (1.0 - failures.mean) / (failures.mean * relative * relative);
  const Eigen::VectorXd weights = Weights(0.0, sample);
  estimate.regions = Regions(sample, weights);
  estimate.warning = Warning(sample, weights, failures);
  estimate.trusted = estimate.warning.empty();
  const bool too_few = failures.effective_sample_size < kLeastEffectiveSize;
  if (level > 0.0 && too_few) SetBound(sample, level, first_bound, estimate);
  return estimate;
}

}  // namespace alula::scenarios::search
