#pragma once

#include <ceres/sized_cost_function.h>

#include "stack/estimation/imu_preintegration.h"
#include "stack/estimation/internal/parameters.h"

namespace alula::stack::estimation {

/// The pre-integrated IMU between two states i and j (Forster et al. 2017, eq. 45), whitened; blocks: pose i,
/// speed-bias i, pose j, speed-bias j. Residual rows: rotation, velocity, position, gyroscope bias, accelerometer bias.
class ImuFactor final : public ceres::SizedCostFunction<15, kPoseSize, kSpeedBiasSize, kPoseSize, kSpeedBiasSize> {
 public:
  explicit ImuFactor(const ImuPreintegration& integral, const base::Vec3& gravity = {0, 0, -base::kGravity})
      : integral_(&integral), gravity_(gravity), W_(integral.SqrtInformation()) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const ImuPreintegration* integral_;
  base::Vec3 gravity_;  // m/s², in O
  Mat15 W_;
};

}  // namespace alula::stack::estimation
