#include "scenarios/campaign/search/internal/gaussian_mixture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/campaign/search/internal/proposal.h"

namespace alula::scenarios::search {
namespace {

TEST(GaussianMixture, DensityIsThatOfTheFormula) {
  Eigen::Matrix2d covariance;
  covariance << 2.0, 0.6, 0.6, 0.5;
  const Eigen::Vector2d mean(1.0, -2.0), at(0.3, -1.1);
  const GaussianMixture mixture = {MakeComponent(0.25, mean, covariance),
                                   MakeComponent(0.75, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity())};
  // The 2×2 inverse and determinant by hand.
  const double determinant = 2.0 * 0.5 - 0.6 * 0.6;
  const Eigen::Vector2d off = at - mean;
  const double form = (0.5 * off[0] * off[0] - 2.0 * 0.6 * off[0] * off[1] + 2.0 * off[1] * off[1]) / determinant;
  const double first = std::exp(-0.5 * form) / (2.0 * M_PI * std::sqrt(determinant));
  const double second = std::exp(-0.5 * at.squaredNorm()) / (2.0 * M_PI);
  EXPECT_NEAR(LogDensities(mixture, at)[0], std::log(0.25 * first + 0.75 * second), 1e-14);
}

TEST(GaussianMixture, TwoSeparateCloudsAreTwoComponents) {
  base::RandomStream random(1, "clouds");
  Eigen::MatrixXd points(3, 400);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double centre = i % 4 == 0 ? 4.0 : -4.0;
    points.col(i) = Eigen::Vector3d(centre + 0.3 * random.Gaussian(), random.Gaussian(), random.Gaussian());
  }
  const GaussianMixture mixture = FitMixture(points, Eigen::VectorXd::Ones(400), 4, random);
  ASSERT_EQ(mixture.size(), 2u);
  for (const GaussianComponent& component : mixture) {
    // One quarter and three quarters; 100 points place a mean of spread 0.3 within 0.1 at three standard errors.
    EXPECT_NEAR(component.weight, component.mean[0] > 0.0 ? 0.25 : 0.75, 1e-6);
    EXPECT_NEAR(std::abs(component.mean[0]), 4.0, 0.1);
  }
}

// E_q[φ/q] = 1 for any proposal that covers the space: its draws and its density belong together.
TEST(Proposal, WeightsHaveMeanOne) {
  for (const Eigen::Index d : {1, 3, 8}) {
    const Eigen::VectorXd mean = Eigen::VectorXd::Constant(d, 1.0);
    const Proposal proposal{{MakeComponent(1.0, mean, 0.5 * Eigen::MatrixXd::Identity(d, d))}, 0.2, 0.3};
    base::RandomStream random(3, "weights");
    const Eigen::MatrixXd points = Draw(proposal, d, 20000, random);
    const Eigen::VectorXd weights = (LogNominal(points) - LogDensities(proposal, points)).array().exp();
    // Weights are at most 1/0.2 = 5 and so spread by at most 2: four standard errors of 20000.
    EXPECT_NEAR(weights.mean(), 1.0, 4.0 * 2.0 / std::sqrt(20000.0)) << d;
    EXPECT_LE(weights.maxCoeff(), 5.0 + 1e-9);
  }
}

TEST(EffectiveSampleSize, CountsEqualWeights) {
  EXPECT_DOUBLE_EQ(EffectiveSampleSize(Eigen::Vector4d(2.0, 2.0, 0.0, 2.0)), 3.0);
  EXPECT_DOUBLE_EQ(EffectiveSampleSize(Eigen::Vector2d::Zero()), 0.0);
}

}  // namespace
}  // namespace alula::scenarios::search
