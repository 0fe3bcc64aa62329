#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/random.h"
#include "scenarios/campaign/search/failure_search.h"
#include "scenarios/campaign/search/internal/gaussian_mixture.h"

namespace alula::scenarios::search {

/// What a batch is drawn from: a fitted mixture and two shares that guard against what the mixture has missed.
///
///   q = (1 - nominal - wide) Σ_k π_k N(μ_k, Σ_k) + nominal N(0, I) + wide W
///   W = ½ N(0, s² I) + ½ mean over axes j of N(0, I + (a² - 1) e_j e_jᵀ)
///
/// The nominal share bounds every weight φ/q by 1/nominal. The wide share looks for other failure regions: half of it
/// in all directions at once, half far out along one parameter, because that is where single causes lie.
struct Proposal {
  GaussianMixture fitted;  // may be empty: then the two shares sum to 1
  double nominal_share = 1.0;
  double wide_share = 0.0;
  double wide_scale = 1.5;
  double axis_scale = 3.0;
};

/// [n] log φ(u) of the columns of points [d×n].
Eigen::VectorXd LogNominal(const Eigen::MatrixXd& points);
/// [n] log q(u).
Eigen::VectorXd LogDensities(const Proposal& proposal, const Eigen::MatrixXd& points);
/// [n] probability that each point was drawn from the two guarding shares.
Eigen::VectorXd GuardShares(const Proposal& proposal, const Eigen::MatrixXd& points);
/// [d×n] independent draws.
Eigen::MatrixXd Draw(const Proposal& proposal, Eigen::Index dimensions, std::int64_t count, base::RandomStream& random);

}  // namespace alula::scenarios::search
