#pragma once

#include <Eigen/Core>
#include <vector>

namespace alula::scenarios::check {

/// What is called a 4-sigma tolerance: two in 30,000 sound quantities fail by chance.
inline constexpr double kSigmas = 4.0;

/// Mean and standard deviation of samples; `sigma_error`: standard error of the standard deviation of normal samples.
struct Spread {
  double mean = 0.0;
  double sigma = 0.0;
  double mean_error = 0.0;
  double sigma_error = 0.0;
};
Spread SpreadOf(const std::vector<double>& samples);

/// Linear least squares, min |A x − b|²: solution and the standard deviation of each unknown out of the
/// residuals themselves.
struct Solution {
  Eigen::VectorXd x;
  Eigen::VectorXd sigma;
};
Solution LeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Standard deviation that an estimated standard deviation has where its n samples are normal: sigma / √(2 (n − 1)).
double SigmaError(double sigma, double samples);

/// Four standard deviations of a share p seen in n trials.
double BinomialTolerance(double p, double n);

}  // namespace alula::scenarios::check
