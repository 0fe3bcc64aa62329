#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/random.h"

namespace alula::scenarios::search {

using Point = Eigen::VectorXd;

/// One normal density with its triangular factor.
struct Gaussian {
  double share = 1.0;
  Point mean;
  Eigen::MatrixXd factor;  // lower triangular, covariance = factor factorᵀ
};

/// A density over R^d: Σ share_k N(mean_k, covariance_k); shares add up to 1.
struct GaussianMixture {
  std::vector<Gaussian> parts;
};

/// The standard normal density of d dimensions.
GaussianMixture StandardNormal(std::size_t dimensions);

/// log of the density at x; of parts that are all too far away it is very low, but finite.
double LogDensity(const GaussianMixture& mixture, const Point& x);

Point Sample(const GaussianMixture& mixture, base::RandomStream& stream);

/// The mixture that fits weighted points best: expectation–maximisation (Dempster, Laird and Rubin 1977) with one to
/// `most_parts` parts, the number by the Bayesian information criterion, as many points counted as the weights are
/// worth. Covariances are shrunk towards their diagonals where there are few points, and none falls below
/// `least_variance`: a proposal that is too narrow gives weights without bound.
GaussianMixture Fit(std::span<const Point> points, std::span<const double> weights, std::size_t most_parts,
                    double least_variance, base::RandomStream& stream);

/// How many equally weighted points such weights are worth (Kish 1965): (Σ w)² / Σ w².
double EffectiveSize(std::span<const double> weights);

}  // namespace alula::scenarios::search
