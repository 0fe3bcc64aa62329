#include "scenarios/check/allan.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace alula::scenarios::check {
namespace {

/// Sum of squared second differences of the integral over clusters of m samples, and how many there are.
struct Sums {
  double squares = 0.0;
  double terms = 0.0;
};
Sums ClusterDifferences(const std::vector<double>& integral, std::size_t m) {
  Sums sums;
  for (std::size_t i = 0; i + 2 * m < integral.size(); ++i) {
    const double d = (integral[i + 2 * m] - 2.0 * integral[i + m] + integral[i]) / static_cast<double>(m);
    sums.squares += d * d;
    sums.terms += 1.0;
  }
  return sums;
}

/// Standard deviation of a root whose square has the standard deviation `square_sigma`; where the square is lost in its
/// own error, the error's root.
double RootSigma(double square, double square_sigma) {
  return square > square_sigma ? 0.5 * square_sigma / std::sqrt(square) : std::sqrt(square_sigma);
}

}  // namespace

std::vector<AllanPoint> AllanCurve(const std::vector<std::vector<double>>& axes) {
  const std::size_t n = axes.front().size();
  std::vector<std::vector<double>> integrals;
  for (const std::vector<double>& axis : axes) {
    double mean = 0.0;
    for (const double value : axis) mean += value / static_cast<double>(n);
    std::vector<double> integral{0.0};
    for (const double value : axis) integral.push_back(integral.back() + value - mean);
    integrals.push_back(std::move(integral));
  }
  std::vector<AllanPoint> curve;
  for (std::size_t m = 1; m <= n / 9; m *= 2) {
    Sums total;
    for (const std::vector<double>& integral : integrals) {
      const Sums sums = ClusterDifferences(integral, m);
      total.squares += sums.squares;
      total.terms += sums.terms;
    }
    const double clusters = static_cast<double>(n) / static_cast<double>(m) - 1.0;
    curve.push_back(
        {static_cast<int>(m), 0.5 * total.squares / total.terms, clusters * static_cast<double>(axes.size())});
  }
  return curve;
}

NoiseDensities FitAllan(const std::vector<AllanPoint>& curve, double period) {
  const auto rows = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixXd A(rows, 2);
  Eigen::VectorXd b(rows), model(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double m = curve[i].cluster, tau = m * period;
    A.row(i) << 1.0 / tau, tau / 3.0 * (1.0 + 0.5 / (m * m));
    b[i] = model[i] = curve[i].variance;
  }
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int pass = 0; pass < 4; ++pass) {  // the weights need the curve itself
    Eigen::VectorXd weights(rows);
    for (Eigen::Index i = 0; i < rows; ++i) weights[i] = curve[i].freedom / (2.0 * model[i] * model[i] + 1e-300);
    const Eigen::Matrix2d normal = A.transpose() * weights.asDiagonal() * A;
    // Scaled to a unit diagonal first: the two columns differ by many powers of ten.
    const Eigen::Vector2d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix2d inverse = (scale.asDiagonal() * normal * scale.asDiagonal()).inverse();
    covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
    squares = covariance * (A.transpose() * weights.asDiagonal() * b);
    squares = squares.cwiseMax(0.0);
    model = A * squares;
  }
  const Eigen::Vector2d sigma = covariance.diagonal().cwiseSqrt();
  // Clusters of one length share their samples with those of the next: where a walk rules, the points move together,
  // and its error is twice that of independent points (measured on synthetic signals: allan's test).
  constexpr double kTogether = 2.0;
  return {std::sqrt(squares[0]), std::sqrt(squares[1]), RootSigma(squares[0], sigma[0]),
          kTogether * RootSigma(squares[1], sigma[1])};
}

}  // namespace alula::scenarios::check
