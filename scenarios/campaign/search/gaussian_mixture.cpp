#include "scenarios/campaign/search/gaussian_mixture.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace alula::scenarios::search {
namespace {

constexpr int kIterations = 60;
constexpr double kConverged = 1e-4;  // change of the mean log-likelihood

double LogNormal(const Gaussian& part, const Point& x) {
  const Point z = part.factor.triangularView<Eigen::Lower>().solve(x - part.mean);
  const auto d = static_cast<double>(x.size());
  return -0.5 * z.squaredNorm() - part.factor.diagonal().array().log().sum() -
         0.5 * d * std::log(2.0 * std::numbers::pi);
}

double LogSum(const std::vector<double>& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - largest);
  return largest + std::log(sum);
}

/// The triangular factor of a covariance whose variance is at least so much in every direction.
Eigen::MatrixXd FactorOf(const Eigen::MatrixXd& covariance, double least_variance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance);
  const Point variances = axes.eigenvalues().cwiseMax(least_variance);
  const Eigen::MatrixXd raised = axes.eigenvectors() * variances.asDiagonal() * axes.eigenvectors().transpose();
  return Eigen::LLT<Eigen::MatrixXd>(raised).matrixL();
}

/// The normal density of weighted points.
Gaussian Moments(std::span<const Point> points, std::span<const double> weights, double least_variance) {
  const Eigen::Index d = points.front().size();
  double total = 0.0;
  Gaussian part;
  part.mean = Point::Zero(d);
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += weights[i];
    part.mean += weights[i] * points[i];
  }
  part.mean /= total;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(d, d);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point off = points[i] - part.mean;
    covariance += weights[i] / total * off * off.transpose();
  }
  // A covariance has d(d+1)/2 numbers: few points tell little about all but the diagonal.
  const double worth = EffectiveSize(weights);
  const double shrink = std::min(1.0, static_cast<double>(d) / worth);
  const Point variances = covariance.diagonal();
  covariance *= 1.0 - shrink;
  covariance.diagonal() = variances;
  part.factor = FactorOf(covariance, least_variance);
  part.share = total;
  return part;
}

/// Centres far from each other (Arthur and Vassilvitskii's k-means++, 2007), then each point to its nearest.
GaussianMixture Begin(std::span<const Point> points, std::span<const double> weights, std::size_t parts,
                      double least_variance, base::RandomStream& stream) {
  const auto draw = [&](const std::vector<double>& chances) {
    double sum = 0.0;
    for (const double chance : chances) sum += chance;
    double left = stream.Uniform() * sum;
    std::size_t i = 0;
    while (i + 1 < chances.size() && left >= chances[i]) left -= chances[i++];
    return i;
  };
  std::vector<Point> centres = {points[draw({weights.begin(), weights.end()})]};
  const auto nearest = [&](const Point& x) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < centres.size(); ++k) {
      if ((x - centres[k]).squaredNorm() < (x - centres[best]).squaredNorm()) best = k;
    }
    return best;
  };
  while (centres.size() < parts) {
    std::vector<double> chances;
    for (std::size_t i = 0; i < points.size(); ++i) {
      chances.push_back(weights[i] * (points[i] - centres[nearest(points[i])]).squaredNorm());
    }
    centres.push_back(points[draw(chances)]);
  }
  GaussianMixture mixture;
  for (std::size_t k = 0; k < parts; ++k) {
    std::vector<double> own(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) own[i] = nearest(points[i]) == k ? weights[i] : 0.0;
    if (*std::max_element(own.begin(), own.end()) > 0.0) mixture.parts.push_back(Moments(points, own, least_variance));
  }
  return mixture;
}

/// One step of expectation and maximisation; the mean log-likelihood before it.
double Improve(std::span<const Point> points, std::span<const double> weights, double least_variance,
               GaussianMixture& mixture) {
  std::vector<std::vector<double>> own(mixture.parts.size(), std::vector<double>(points.size()));
  double likelihood = 0.0, total = 0.0;
  std::vector<double> logs(mixture.parts.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < logs.size(); ++k) {
      logs[k] = std::log(mixture.parts[k].share) + LogNormal(mixture.parts[k], points[i]);
    }
    const double log = LogSum(logs);
    for (std::size_t k = 0; k < logs.size(); ++k) own[k][i] = weights[i] * std::exp(logs[k] - log);
    likelihood += weights[i] * log;
    total += weights[i];
  }
  GaussianMixture next;
  for (const std::vector<double>& share : own) {
    double sum = 0.0;
    for (const double s : share) sum += s;
    if (sum > 1e-6 * total) next.parts.push_back(Moments(points, share, least_variance));
  }
  for (Gaussian& part : next.parts) part.share /= total;
  mixture = std::move(next);
  return likelihood / total;
}

}  // namespace

GaussianMixture StandardNormal(std::size_t dimensions) {
  const auto d = static_cast<Eigen::Index>(dimensions);
  return {{{1.0, Point::Zero(d), Eigen::MatrixXd::Identity(d, d)}}};
}

double LogDensity(const GaussianMixture& mixture, const Point& x) {
  std::vector<double> logs;
  for (const Gaussian& part : mixture.parts) logs.push_back(std::log(part.share) + LogNormal(part, x));
  return LogSum(logs);
}

Point Sample(const GaussianMixture& mixture, base::RandomStream& stream) {
  double left = stream.Uniform();
  std::size_t k = 0;
  while (k + 1 < mixture.parts.size() && left >= mixture.parts[k].share) left -= mixture.parts[k++].share;
  const Gaussian& part = mixture.parts[k];
  Point z(part.mean.size());
  for (double& value : z) value = stream.Gaussian();
  return part.mean + part.factor.triangularView<Eigen::Lower>() * z;
}

double EffectiveSize(std::span<const double> weights) {
  double sum = 0.0, squares = 0.0;
  for (const double w : weights) {
    sum += w;
    squares += w * w;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

GaussianMixture Fit(std::span<const Point> points, std::span<const double> weights, std::size_t most_parts,
                    double least_variance, base::RandomStream& stream) {
  const auto d = static_cast<double>(points.front().size());
  const double worth = EffectiveSize(weights);
  GaussianMixture best;
  double best_score = std::numeric_limits<double>::infinity();
  for (std::size_t parts = 1; parts <= most_parts; ++parts) {
    const double numbers = static_cast<double>(parts) * (1.0 + d + d * (d + 1.0) / 2.0) - 1.0;
    if (parts > 1 && numbers > worth) break;
    GaussianMixture mixture = Begin(points, weights, parts, least_variance, stream);
    double total = 0.0;
    for (const Gaussian& part : mixture.parts) total += part.share;
    for (Gaussian& part : mixture.parts) part.share /= total;
    double likelihood = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kIterations; ++i) {
      const double now = Improve(points, weights, least_variance, mixture);
      if (now - likelihood < kConverged) break;
      likelihood = now;
    }
    const double score = numbers * std::log(worth) - 2.0 * worth * likelihood;
    if (score >= best_score) continue;
    best_score = score;
    best = std::move(mixture);
  }
  return best;
}

}  // namespace alula::scenarios::search
