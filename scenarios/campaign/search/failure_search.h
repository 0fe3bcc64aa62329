#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "scenarios/campaign/search/gaussian_mixture.h"
#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::search {

struct FailureSearchConfig {
  std::int64_t max_runs = 5000;
  std::int64_t batch = 0;       // runs a level; 0: an eighth of max_runs, 50 to 1000
  double elite = 0.1;           // share of a batch, the worst, towards which the next level moves
  double relative_error = 0.1;  // standard error of the estimate that is asked for
  double defensive = 0.1;       // share of the last proposal that stays the nominal density
  std::size_t most_parts = 3;   // of a proposal: separate regions of failure
};

/// How rare failures are, and where.
struct FailureEstimate {
  bool found = false;  // false: no failure was reached, and `interval` is 0 to an upper bound
  double probability = 0.0;
  double standard_error = 0.0;
  statistics::Interval interval;  // at 95 %
  std::int64_t runs = 0;          // of all levels
  std::int64_t final_runs = 0;    // of which the estimate is made
  std::int64_t final_failures = 0;
  double effective_failures = 0.0;  // what the weighted failures are worth
  double plain_runs = 0.0;          // that plain sampling needs for the same relative error
  int levels = 0;
  std::string warning;  // why the stated error should not be trusted; empty where it may be
  struct Region {
    double share = 0.0;  // of the probability
    Point mean, spread;  // of failing points, standard normal coordinates
  };
  std::vector<Region> regions;  // the likeliest first
};

/// Looks for rare failures by adaptive importance sampling: the cross-entropy method (Rubinstein and Kroese 2004) with
/// Gaussian mixtures as proposals (Geyer, Papaioannou and Straub 2019). Points are in standard normal space; a run
/// whose margin is 0 or less failed. Each level moves the proposal towards the worst runs of the level before it, until
/// they are failures. Then the proposal is fixed, mixed with some of the nominal density, and FRESH points are drawn:
///   p ≈ 1/n Σ [margin ≤ 0] φ(u) / q(u)
/// which is unbiased, because q and n follow from earlier runs alone. A region of failures that no level met is not in
/// the stated error; what plain sampling would miss as well, no method can exclude.
///
/// Ask for points, fly them, tell their margins, until done. Everything follows from the seed and the margins told.
class FailureSearch {
 public:
  FailureSearch(const FailureSearchConfig& config, std::size_t dimensions, std::uint64_t seed);

  bool done() const { return stage_ == Stage::kDone; }
  const std::vector<Point>& Ask() const { return points_; }
  /// A margin for each point asked for; −∞ is the worst, NaN counts as that.
  void Tell(std::span<const double> margins);
  FailureEstimate estimate() const { return estimate_; }

 private:
  enum class Stage { kLevels, kFinal, kDone };
  void Draw(std::int64_t runs);
  std::vector<double> LogWeights() const;
  void Adapt(std::span<const double> margins);
  void Prepare(std::span<const double> margins, const std::vector<double>& log_weights);
  void Conclude(std::span<const double> margins);
  void GiveUp();

  FailureSearchConfig config_;
  base::RandomStream stream_;
  GaussianMixture nominal_, proposal_;
  std::vector<Point> points_;
  Stage stage_ = Stage::kLevels;
  std::int64_t plain_failures_ = 0, plain_runs_ = 0;  // of the first level, which is plain sampling
  FailureEstimate estimate_;
};

}  // namespace alula::scenarios::search
