#pragma once

#include <ceres/cost_function.h>

#include "stack/estimation/internal/linear_system.h"

namespace alula::stack::estimation {

/// A LinearPrior as the solver sees it; blocks in the prior's order.
class PriorFactor final : public ceres::CostFunction {
 public:
  explicit PriorFactor(const LinearPrior& prior);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const LinearPrior* prior_;
};

}  // namespace alula::stack::estimation
