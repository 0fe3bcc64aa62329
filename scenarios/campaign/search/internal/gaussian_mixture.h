#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/random.h"

namespace alula::scenarios::search {

/// One Gaussian of a mixture in d dimensions.
struct GaussianComponent {
  double weight = 1.0;
  Eigen::VectorXd mean;    // [d]
  Eigen::MatrixXd factor;  // [d×d] lower Cholesky factor of the covariance
  double log_peak = 0.0;   // log density at the mean
};

/// Weights sum to 1.
using GaussianMixture = std::vector<GaussianComponent>;

/// Throws FaultError where the covariance is not positive definite.
GaussianComponent MakeComponent(double weight, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance);

/// [K×n] log of weight times density of every component at the columns of points [d×n].
Eigen::MatrixXd LogComponentDensities(const GaussianMixture& mixture, const Eigen::MatrixXd& points);
/// [n] log density of the mixture.
Eigen::VectorXd LogDensities(const GaussianMixture& mixture, const Eigen::MatrixXd& points);
/// [n] log Σ exp of each column, for columns of any size of exponent.
Eigen::VectorXd LogSumOfColumns(const Eigen::MatrixXd& logs);

/// One of the components, by their weights.
std::size_t PickComponent(const GaussianMixture& mixture, base::RandomStream& random);

/// The mixture of at most `max_components` Gaussians that fits weighted points best: expectation–maximisation with the
/// number of components by the Bayesian information criterion (Schwarz 1978) on the effective sample size. Covariances
/// are drawn towards the identity as by d further points, which is what they are in every direction that the points
/// say nothing about. points [d×n], weights [n] ≥ 0 with a positive sum.
GaussianMixture FitMixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, int max_components,
                           base::RandomStream& random);

/// (Σw)² / Σw²: how many equally weighted points say as much (Kish 1965). 0 for no weight at all.
double EffectiveSampleSize(const Eigen::VectorXd& weights);

}  // namespace alula::scenarios::search
