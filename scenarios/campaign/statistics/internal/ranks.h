#pragma once

#include <span>
#include <vector>

namespace alula::scenarios::statistics {

/// Ranks from 1, doubled: tied values share the mean of their ranks, which doubled is whole.
struct Ranks {
  std::vector<int> twice_rank;  // by value, in the order given
  double ties = 0.0;            // Σ t³ - t over groups of t equal values, which takes from the variance
};
Ranks RankDoubled(std::span<const double> values);

/// P(|X| ≥ |z|) of a standard normal X.
double TwoSidedNormal(double z);

/// Two-sided p of an integer statistic from its distribution: twice the smaller tail at `observed`, at most 1.
/// `weights[s]` is proportional to P(statistic = s).
double TwoSidedExact(std::span<const double> weights, int observed);

}  // namespace alula::scenarios::statistics
