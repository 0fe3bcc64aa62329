#include "scenarios/check/statistics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace alula::scenarios::check {

double SigmaError(double sigma, double samples) { return sigma / std::sqrt(2.0 * std::max(1.0, samples - 1.0)); }

Spread SpreadOf(const std::vector<double>& samples) {
  const auto n = static_cast<double>(samples.size());
  Spread spread;
  for (const double sample : samples) spread.mean += sample / n;
  double squares = 0.0;
  for (const double sample : samples) squares += (sample - spread.mean) * (sample - spread.mean);
  spread.sigma = std::sqrt(squares / (n - 1.0));
  spread.mean_error = spread.sigma / std::sqrt(n);
  spread.sigma_error = SigmaError(spread.sigma, n);
  return spread;
}

Solution LeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::MatrixXd normal = A.transpose() * A;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  Solution solution;
  solution.x = solver.solve(A.transpose() * b);
  const double freedom = std::max(1.0, static_cast<double>(A.rows() - A.cols()));
  const double variance = (A * solution.x - b).squaredNorm() / freedom;
  const Eigen::MatrixXd covariance = variance * solver.solve(Eigen::MatrixXd::Identity(A.cols(), A.cols()));
  solution.sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return solution;
}

double BinomialTolerance(double p, double n) { return kSigmas * std::sqrt(p * (1.0 - p) / n); }

}  // namespace alula::scenarios::check
