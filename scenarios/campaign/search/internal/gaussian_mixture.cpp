#include "scenarios/campaign/search/internal/gaussian_mixture.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace alula::scenarios::search {

namespace {

constexpr int kMaxIterations = 60;
constexpr double kSettled = 1e-4;       // mean log likelihood per iteration: far below what the choice of K looks at
constexpr double kLeastPoints = 2.0;    // effective points below which a component is dropped
constexpr double kInitialSpread = 0.5;  // of new components, in standard deviations of the nominal density

struct Fit {
  GaussianMixture mixture;
  double mean_log_likelihood = -std::numeric_limits<double>::infinity();
};

std::size_t Pick(const Eigen::VectorXd& weights, base::RandomStream& random) {
  double left = random.Uniform() * weights.sum();
  Eigen::Index i = 0;
  while (i + 1 < weights.size() && (left -= weights[i]) >= 0.0) ++i;
  return static_cast<std::size_t>(i);
}

/// Centres far from each other (k-means++, Arthur & Vassilvitskii 2007).
GaussianMixture Spread(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, int components,
                       base::RandomStream& random) {
  const Eigen::Index d = points.rows();
  const Eigen::MatrixXd covariance = kInitialSpread * kInitialSpread * Eigen::MatrixXd::Identity(d, d);
  GaussianMixture mixture;
  Eigen::VectorXd chance = weights;
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(points.cols(), std::numeric_limits<double>::infinity());
  for (int k = 0; k < components && chance.sum() > 0.0; ++k) {
    const Eigen::VectorXd centre = points.col(static_cast<Eigen::Index>(Pick(chance, random)));
    mixture.push_back(MakeComponent(1.0 / components, centre, covariance));
    nearest = nearest.cwiseMin((points.colwise() - centre).colwise().squaredNorm().transpose());
    chance = weights.cwiseProduct(nearest);
  }
  return mixture;
}

/// `shares` [K×n]: each point's weight, dealt out to the components.
GaussianMixture Maximise(const Eigen::MatrixXd& points, const Eigen::MatrixXd& shares, double effective_points) {
  const Eigen::Index d = points.rows();
  const auto pull = static_cast<double>(d);
  GaussianMixture mixture;
  double kept = 0.0;
  for (Eigen::Index k = 0; k < shares.rows(); ++k) {
    const Eigen::VectorXd share = shares.row(k).transpose();
    const double sum = share.sum();
    const double count = sum * effective_points;
    if (count < kLeastPoints) continue;
    const Eigen::VectorXd mean = points * share / sum;
    const Eigen::MatrixXd off = points.colwise() - mean;
    const Eigen::MatrixXd scatter = off * share.asDiagonal() * off.transpose() / sum;
    const Eigen::MatrixXd covariance = (count * scatter + pull * Eigen::MatrixXd::Identity(d, d)) / (count + pull);
    mixture.push_back(MakeComponent(sum, mean, covariance));
    kept += sum;
  }
  for (GaussianComponent& component : mixture) component.weight /= kept;
  return mixture;
}

Fit Climb(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, GaussianMixture start) {
  const double effective_points = EffectiveSampleSize(weights);
  Fit fit{std::move(start), -std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::MatrixXd logs = LogComponentDensities(fit.mixture, points);
    const Eigen::VectorXd log_density = LogSumOfColumns(logs);
    const double before = fit.mean_log_likelihood;
    fit.mean_log_likelihood = weights.dot(log_density);
    if (fit.mean_log_likelihood - before < kSettled && i > 1) break;
    const Eigen::MatrixXd shares =
        (logs.rowwise() - log_density.transpose()).array().exp().matrix() * weights.asDiagonal();
    GaussianMixture next = Maximise(points, shares, effective_points);
    if (next.empty()) break;
    fit.mixture = std::move(next);
  }
  return fit;
}

/// Free numbers of a mixture; those of a covariance count as far as the points, not the identity, decide them.
double Parameters(const GaussianMixture& mixture, Eigen::Index dimensions, double effective_points) {
  const auto d = static_cast<double>(dimensions), k = static_cast<double>(mixture.size());
  const double count = effective_points / k;
  return k - 1.0 + k * d + k * d * (d + 1.0) / 2.0 * count / (count + d);
}

}  // namespace

GaussianComponent MakeComponent(double weight, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  if (cholesky.info() != Eigen::Success) throw base::FaultError("not_definite", "a covariance is not definite");
  GaussianComponent component{weight, mean, cholesky.matrixL(), 0.0};
  component.log_peak =
      -component.factor.diagonal().array().log().sum() - 0.5 * static_cast<double>(mean.size()) * std::log(2.0 * M_PI);
  return component;
}

Eigen::MatrixXd LogComponentDensities(const GaussianMixture& mixture, const Eigen::MatrixXd& points) {
  Eigen::MatrixXd logs(static_cast<Eigen::Index>(mixture.size()), points.cols());
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const GaussianComponent& c = mixture[k];
    Eigen::MatrixXd off = points.colwise() - c.mean;
    c.factor.triangularView<Eigen::Lower>().solveInPlace(off);
    logs.row(static_cast<Eigen::Index>(k)) =
        (-0.5 * off.colwise().squaredNorm()).array() + (std::log(c.weight) + c.log_peak);
  }
  return logs;
}

Eigen::VectorXd LogSumOfColumns(const Eigen::MatrixXd& logs) {
  const Eigen::RowVectorXd top = logs.colwise().maxCoeff();
  return (top.array() + (logs.rowwise() - top).array().exp().colwise().sum().log()).matrix().transpose();
}

Eigen::VectorXd LogDensities(const GaussianMixture& mixture, const Eigen::MatrixXd& points) {
  return LogSumOfColumns(LogComponentDensities(mixture, points));
}

std::size_t PickComponent(const GaussianMixture& mixture, base::RandomStream& random) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(mixture.size()));
  for (std::size_t k = 0; k < mixture.size(); ++k) weights[static_cast<Eigen::Index>(k)] = mixture[k].weight;
  return Pick(weights, random);
}

GaussianMixture FitMixture(const Eigen::MatrixXd& points, const Eigen::VectorXd& weights, int max_components,
                           base::RandomStream& random) {
  const Eigen::VectorXd share = weights / weights.sum();
  const double effective_points = EffectiveSampleSize(weights);
  Fit best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (int components = 1; components <= max_components; ++components) {
    Fit fit = Climb(points, share, Spread(points, share, components, random));
    const double score = effective_points * fit.mean_log_likelihood -
                         0.5 * Parameters(fit.mixture, points.rows(), effective_points) * std::log(effective_points);
    if (components > 1 && score <= best_score) continue;
    best_score = score;
    best = std::move(fit);
  }
  return best.mixture;
}

double EffectiveSampleSize(const Eigen::VectorXd& weights) {
  const double squares = weights.squaredNorm();
  return squares > 0.0 ? weights.sum() * weights.sum() / squares : 0.0;
}

}  // namespace alula::scenarios::search
