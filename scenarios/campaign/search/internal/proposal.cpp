#include "scenarios/campaign/search/internal/proposal.h"

#include <cmath>

namespace alula::scenarios::search {

namespace {

double LogNormaliser(Eigen::Index dimensions) { return -0.5 * static_cast<double>(dimensions) * std::log(2.0 * M_PI); }

/// log W.
Eigen::VectorXd LogWide(const Proposal& proposal, const Eigen::MatrixXd& points) {
  const auto d = static_cast<double>(points.rows());
  const double s = proposal.wide_scale, a = proposal.axis_scale;
  const Eigen::VectorXd squared = points.colwise().squaredNorm().transpose();
  Eigen::MatrixXd logs(2, points.cols());
  logs.row(0) = (-0.5 / (s * s) * squared.array() + (LogNormaliser(points.rows()) - d * std::log(s))).transpose();
  // N(0, I + (a² - 1) e_j e_jᵀ) = φ(u) exp(u_j² (1 - 1/a²) / 2) / a
  const Eigen::VectorXd along = LogSumOfColumns(0.5 * (1.0 - 1.0 / (a * a)) * points.array().square().matrix());
  logs.row(1) = (LogNominal(points) + along).array() - std::log(a * d);
  return LogSumOfColumns(logs).array() + std::log(0.5);
}

/// [3×n] log of share times density: fitted, nominal, wide.
Eigen::MatrixXd LogParts(const Proposal& proposal, const Eigen::MatrixXd& points) {
  const double fitted_share = proposal.fitted.empty() ? 0.0 : 1.0 - proposal.nominal_share - proposal.wide_share;
  Eigen::MatrixXd logs(3, points.cols());
  logs.row(0).setConstant(std::log(0.0));
  logs.row(2).setConstant(std::log(0.0));
  if (!proposal.fitted.empty()) {
    logs.row(0) = LogDensities(proposal.fitted, points).transpose().array() + std::log(fitted_share);
  }
  logs.row(1) = LogNominal(points).transpose().array() + std::log(proposal.nominal_share);
  if (proposal.wide_share > 0.0) {
    logs.row(2) = LogWide(proposal, points).transpose().array() + std::log(proposal.wide_share);
  }
  return logs;
}

Eigen::VectorXd Normals(Eigen::Index dimensions, base::RandomStream& random) {
  Eigen::VectorXd normals(dimensions);
  for (double& value : normals) value = random.Gaussian();
  return normals;
}

}  // namespace

Eigen::VectorXd LogNominal(const Eigen::MatrixXd& points) {
  return (-0.5 * points.colwise().squaredNorm().transpose()).array() + LogNormaliser(points.rows());
}

Eigen::VectorXd LogDensities(const Proposal& proposal, const Eigen::MatrixXd& points) {
  return LogSumOfColumns(LogParts(proposal, points));
}

Eigen::VectorXd GuardShares(const Proposal& proposal, const Eigen::MatrixXd& points) {
  const Eigen::MatrixXd logs = LogParts(proposal, points);
  return 1.0 - (logs.row(0).transpose() - LogSumOfColumns(logs)).array().exp();
}

Eigen::MatrixXd Draw(const Proposal& proposal, Eigen::Index dimensions, std::int64_t count,
                     base::RandomStream& random) {
  Eigen::MatrixXd points(dimensions, count);
  for (auto point : points.colwise()) {
    const double part = random.Uniform();
    if (part < proposal.nominal_share) {
      point = Normals(dimensions, random);
    } else if (part >= proposal.nominal_share + proposal.wide_share && !proposal.fitted.empty()) {
      const GaussianComponent& component = proposal.fitted[PickComponent(proposal.fitted, random)];
      point = component.mean + component.factor * Normals(dimensions, random);
    } else if (random.Uniform() < 0.5) {
      point = proposal.wide_scale * Normals(dimensions, random);
    } else {
      point = Normals(dimensions, random);
      point[static_cast<Eigen::Index>(random.Index(static_cast<std::uint64_t>(dimensions)))] *= proposal.axis_scale;
    }
  }
  return points;
}

}  // namespace alula::scenarios::search
