#include "scenarios/campaign/statistics/internal/log_beta.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace alula::scenarios::statistics {
namespace {

/// Brute-force twin: Simpson's rule on t = x + (1 - x) (1 - v²)… with the integrand's logarithm, scaled by its peak.
double LogUpperBySum(double a, double b, double x) {
  constexpr int kSteps = 2000000;
  const auto log_integrand = [&](double v) {  // 1 - t = (1 - x) v⁴ takes the pole of b < 1 away
    const double rest = (1.0 - x) * v * v * v * v;
    return (a - 1.0) * std::log1p(-rest) + (b - 1.0) * std::log(rest) + std::log(4.0 * (1.0 - x)) + 3.0 * std::log(v);
  };
  std::vector<double> logs(kSteps);
  for (int i = 0; i < kSteps; ++i) logs[i] = log_integrand((i + 0.5) / kSteps);
  const double peak = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - peak);
  return peak + std::log(sum / kSteps);
}

TEST(LogBeta, AgreesWithASum) {
  const double cases[][3] = {
      {0.5, 0.25, 0.95}, {60.5, 0.25, 0.95}, {50.5, 10.25, 0.95}, {900.5, 100.5, 0.95}, {700.5, 300.25, 0.95}};
  for (const auto& [a, b, x] : cases) {
    // 1e-6: the midpoint rule with two million steps.
    EXPECT_NEAR(LogUpperBeta(a, b, x), LogUpperBySum(a, b, x), 1e-6) << a << " " << b;
    EXPECT_NEAR(LogLowerBeta(b, a, 1.0 - x), LogUpperBeta(a, b, x), 1e-9);
  }
}

// Where the share of the tail falls under the smallest double, the other formula takes over without a step.
TEST(LogBeta, GoesOnBelowTheSmallestDouble) {
  double before = LogUpperBeta(1000.5, 100.5, 0.95), step_before = 0.0;
  for (double f = 110.5; f < 3000.0; f += 10.0) {
    const double now = LogUpperBeta(1000.5, f, 0.95);
    const double step = now - before;
    ASSERT_TRUE(std::isfinite(now)) << f;
    EXPECT_LT(step, 0.0);
    if (step_before != 0.0) {  // one factor (1 - t) ≈ 0.05 per unit of f
      EXPECT_NEAR(step, step_before, 0.1) << f;
    }
    before = now;
    step_before = step;
  }
}

}  // namespace
}  // namespace alula::scenarios::statistics
