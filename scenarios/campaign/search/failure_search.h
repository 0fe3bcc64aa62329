#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenarios/campaign/statistics/binomial.h"

namespace alula::scenarios::search {

/// Keys of a search. Validate names the key that is out of range (InputError).
struct FailureSearchConfig {
  std::int64_t max_runs = 5000;   // in all, levels and final sample
  std::int64_t level_runs = 300;  // a level; fewer than some 20 a dimension fit covariances badly
  double level_share = 0.25;      // effective size of the set that a level is fitted to, of level_runs: larger is
                                  // steadier and takes more levels
  double final_share = 0.4;       // of max_runs: kept for the final sample whatever the levels do
  std::int64_t min_final_runs = 500;
  double relative_error = 0.1;  // aim of the final sample: it takes no more runs than this seems to need
  double nominal_share = 0.1;   // of every sample: drawn as parameters are distributed, bounds weights by 1/share
  double wide_share = 0.2;      // of every sample: spread wider, to find regions that the levels have missed
  int max_components = 4;       // Gaussians in the mixture: at most so many failure regions are told apart

  void Validate() const;
};

/// Where failures lie, in standard-normal space, as the caller maps back to parameters.
struct FailureRegion {
  double share = 0.0;          // of the failure probability
  std::int64_t failures = 0;   // runs of the final sample that belong to it
  std::vector<double> mean;    // [d] of the failing points, as they would occur
  std::vector<double> spread;  // [d] standard deviation of the same
};

struct FailureEstimate {
  /// Whether failures were seen in the final sample; else probability and standard_error are 0. Without any, or with
  /// few and the levels ended above margin 0, the interval is [0, upper bound] at 95 %: the smaller of
  ///  - the upper end for P(margin ≤ level), from the final sample: that set contains all failures;
  ///  - Clopper–Pearson's for the share of the first level's runs that failed, over the nominal share of that level.
  bool found = false;
  double probability = 0.0;
  double standard_error = 0.0;
  statistics::Interval interval;  // 95 %
  std::string bound_from;         // where the upper bound comes from, in words; empty where there is none
  std::int64_t runs = 0;          // spent in all
  std::int64_t final_runs = 0;    // of them in the final sample
  std::int64_t failures = 0;      // seen in the final sample
  int levels = 0;
  double level = 0.0;                  // margin that the last level reached; 0: the failures themselves
  double effective_sample_size = 0.0;  // of the failures in the final sample
  double plain_runs = 0.0;             // runs by plain sampling for the same relative error: (1-p) / (p δ²)
  bool trusted = false;                // false: standard error and interval may be far too small; warning says why
  std::string warning;
  std::vector<FailureRegion> regions;  // the largest share first
};

/// Searches for rare failures and estimates their probability; the caller does the runs.
///
///   while (!search.done()) search.Tell(margins of search.Ask());
///
/// Points are of the standard-normal space Rᵈ: parameters at their nominal distribution are N(0, I). A run's margin
/// says how far it was from failing: ≤ 0 is a failure, -∞ one without a number (a crash), +∞ a pass without one.
/// Margins may be noisy; the probability is then over points and noise.
///
/// Levels (cross-entropy method, de Boer et al. 2005; Gaussian mixtures as Geyer, Papaioannou & Straub 2019): the
/// points with the smallest margins, weighted to their nominal density, are fitted by a mixture, from which the next
/// level is drawn. All levels so far count, weighted against the mixture of all their densities (Veach & Guibas 1995;
/// Cornuet et al. 2012), so that no region is forgotten. At margin 0 the proposal is fixed and the final sample is
/// drawn fresh from it, its size settled before: so that Σ 1(margin ≤ 0) φ/q / n is unbiased.
///
/// What no method can promise: a region that no level came near is neither in the estimate nor in its error. The wide
/// share is there to find it, and failures found apart from the mixture make the estimate untrusted. Sound to some
/// 20 dimensions; beyond, weights degenerate, which the effective sample size shows.
///
/// Deterministic: the same seed and margins give the same points, so that a search is resumed by telling again.
class FailureSearch {
 public:
  FailureSearch(const FailureSearchConfig& config, std::size_t dimensions, std::uint64_t seed);
  ~FailureSearch();
  FailureSearch(FailureSearch&&) noexcept;
  FailureSearch& operator=(FailureSearch&&) noexcept;

  /// [n][d] the points to run next; the same ones until they are told. Empty when done.
  std::vector<std::vector<double>> Ask() const;
  /// Margins of all points of Ask(), in their order. FaultError for another number of them or one that is NaN.
  void Tell(std::span<const double> margins);
  bool done() const;
  /// FaultError before done().
  const FailureEstimate& estimate() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace alula::scenarios::search
