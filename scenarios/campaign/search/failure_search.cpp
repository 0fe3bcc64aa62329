#include "scenarios/campaign/search/failure_search.h"

#include <algorithm>
#include <cmath>

namespace alula::scenarios::search {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kNormal95 = 1.959963984540054;
// Of a proposal; the nominal variance is 1. What lies beyond a limit thins out as an exponential does, and a Gaussian
// that fits its variance has a lighter tail: rare points would carry most of the weight. Hence this floor, and the last
// proposal is wider than its fit in every direction.
constexpr double kLeastVariance = 0.35;
constexpr double kWiden = 1.25;        // of variances
constexpr double kFewFailures = 20.0;  // fewer are worth no stated error
constexpr double kReserve = 1.5;       // more runs than the last level says are needed
constexpr double kWorthKnowing = 0.1;  // of a batch: what its failures are to be worth before the last runs
constexpr int kMostLevels = 12;

std::int64_t BatchOf(const FailureSearchConfig& config) {
  const std::int64_t usual = std::clamp<std::int64_t>(config.max_runs / 8, 50, 1000);
  return std::min(config.max_runs, config.batch > 0 ? config.batch : usual);
}

double Ordered(double margin) { return std::isnan(margin) ? -std::numeric_limits<double>::infinity() : margin; }

/// The share-quantile of margins.
double Level(std::span<const double> margins, double share) {
  std::vector<double> sorted;
  for (const double margin : margins) sorted.push_back(Ordered(margin));
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// Mean and standard error of weighted failures.
struct Mean {
  double value = 0.0, error = 0.0;
};
Mean MeanOf(const std::vector<double>& terms) {
  const auto n = static_cast<double>(terms.size());
  double sum = 0.0, squares = 0.0;
  for (const double x : terms) sum += x;
  for (const double x : terms) squares += (x - sum / n) * (x - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

}  // namespace

FailureSearch::FailureSearch(const FailureSearchConfig& config, std::size_t dimensions, std::uint64_t seed)
    : config_(config), stream_(seed, "failure_search"), nominal_(StandardNormal(dimensions)), proposal_(nominal_) {
  config_.batch = BatchOf(config);
  Draw(config_.batch);
}

void FailureSearch::Draw(std::int64_t runs) {
  points_.clear();
  for (std::int64_t i = 0; i < runs; ++i) points_.push_back(Sample(proposal_, stream_));
}

std::vector<double> FailureSearch::LogWeights() const {
  std::vector<double> logs;
  for (const Point& u : points_) logs.push_back(LogDensity(nominal_, u) - LogDensity(proposal_, u));
  return logs;
}

void FailureSearch::Tell(std::span<const double> margins) {
  estimate_.runs += static_cast<std::int64_t>(margins.size());
  if (stage_ == Stage::kFinal) {
    Conclude(margins);
  } else {
    Adapt(margins);
  }
}

void FailureSearch::Adapt(std::span<const double> margins) {
  if (estimate_.levels++ == 0) {
    plain_runs_ = static_cast<std::int64_t>(margins.size());
    plain_failures_ = std::count_if(margins.begin(), margins.end(), [](double m) { return Ordered(m) <= 0.0; });
  }
  const std::vector<double> log_weights = LogWeights();
  const double level = std::max(0.0, Level(margins, config_.elite));
  const std::int64_t left = config_.max_runs - estimate_.runs;
  const bool more = left >= 2 * config_.batch && estimate_.levels < kMostLevels;
  std::vector<Point> elite;
  std::vector<double> weights;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    if (Ordered(margins[i]) > level) continue;
    elite.push_back(points_[i]);
    weights.push_back(std::exp(log_weights[i]));
  }
  const double worth = EffectiveSize(weights);
  // Failures that a proposal met on its first step into their region are worth few: it goes one step further.
  const bool enough = worth >= kWorthKnowing * static_cast<double>(margins.size()) || 2 * left < config_.max_runs;
  if (level == 0.0 && (!more || enough)) {
    return Prepare(margins, log_weights);
  }
  if (!more) return GiveUp();
  proposal_ = Fit(elite, weights, config_.most_parts, kLeastVariance, stream_);
  Draw(config_.batch);
}

/// The worst tenth of the last level are failures: the last proposal is fitted to them, and the last runs are counted.
void FailureSearch::Prepare(std::span<const double> margins, const std::vector<double>& log_weights) {
  std::vector<Point> failures;
  std::vector<double> weights, terms;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const bool failed = Ordered(margins[i]) <= 0.0;
    terms.push_back(failed ? std::exp(log_weights[i]) : 0.0);
    if (!failed) continue;
    failures.push_back(points_[i]);
    weights.push_back(terms.back());
  }
  const std::int64_t left = config_.max_runs - estimate_.runs;
  if (left < 2) return GiveUp();
  const Mean so_far = MeanOf(terms);
  const double relative = so_far.error / so_far.value * std::sqrt(static_cast<double>(terms.size()));
  const double needed = kReserve * relative * relative / (config_.relative_error * config_.relative_error);
  const auto wanted = static_cast<std::int64_t>(std::min(needed, 1e15));
  proposal_ = Fit(failures, weights, config_.most_parts, kLeastVariance, stream_);
  for (Gaussian& part : proposal_.parts) {
    part.share *= 1.0 - config_.defensive;
    part.factor *= std::sqrt(kWiden);
  }
  proposal_.parts.push_back(nominal_.parts.front());
  proposal_.parts.back().share = config_.defensive;
  stage_ = Stage::kFinal;
  Draw(std::clamp(wanted, std::min(left, config_.batch), left));
}

void FailureSearch::Conclude(std::span<const double> margins) {
  const std::vector<double> log_weights = LogWeights();
  std::vector<Point> failures;
  std::vector<double> terms, weights;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const bool failed = Ordered(margins[i]) <= 0.0;
    terms.push_back(failed ? std::exp(log_weights[i]) : 0.0);
    if (!failed) continue;
    failures.push_back(points_[i]);
    weights.push_back(terms.back());
  }
  const Mean mean = MeanOf(terms);
  estimate_.final_runs = static_cast<std::int64_t>(margins.size());
  estimate_.final_failures = static_cast<std::int64_t>(failures.size());
  points_.clear();
  if (failures.empty()) return GiveUp();
  stage_ = Stage::kDone;
  estimate_.found = true;
  estimate_.probability = mean.value;
  estimate_.standard_error = mean.error;
  estimate_.effective_failures = EffectiveSize(weights);
  const double relative = mean.error / mean.value;
  const double factor = std::exp(kNormal95 * relative);  // on the scale of logarithms: weights are skewed
  estimate_.interval = {mean.value / factor, std::min(1.0, mean.value * factor)};
  estimate_.plain_runs = (1.0 - mean.value) / (mean.value * relative * relative);
  if (estimate_.effective_failures < kFewFailures) {
    estimate_.warning = "the failures found are worth few: the stated error may be too small; allow more runs";
  }
  for (const Gaussian& part : Fit(failures, weights, config_.most_parts, kLeastVariance, stream_).parts) {
    estimate_.regions.push_back(
        {part.share, part.mean, (part.factor * part.factor.transpose()).diagonal().cwiseSqrt()});
  }
  std::sort(estimate_.regions.begin(), estimate_.regions.end(),
            [](const auto& a, const auto& b) { return a.share > b.share; });
}

/// What the first level says, which was plain sampling.
void FailureSearch::GiveUp() {
  stage_ = Stage::kDone;
  points_.clear();
  estimate_.found = false;
  estimate_.interval = {0.0, statistics::UpperBound(plain_failures_, plain_runs_, kConfidence)};
  estimate_.warning = "the runs allowed were not enough to reach failures; the bound is that of the first level alone";
}

}  // namespace alula::scenarios::search
