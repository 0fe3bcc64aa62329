#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "stack/estimation/internal/line_geometry.h"
#include "stack/estimation/internal/reprojection_factor.h"

namespace alula::stack::estimation {

/// A segment as one eye sees it, normalised coordinates, from `a` to `b`.
struct SeenSegment {
  base::Vec2 a = base::Vec2::Zero(), b = base::Vec2::Zero();
};

/// P0's residual of a line (section 3.4) in sigmas; blocks: pose, line, rig. With (n, v) in the eye's frame, as
/// ReprojectionFactor brings points there, the line is seen as the set of m with mᵀ n = 0 and runs along n × e_z:
///   r₁ = (m̄ᵀ n) / |n_xy| / σ,   m̄ the segment's middle,            σ = sigma / √2
///   r₂ = atan2(d × d', d · d') / σ_angle,  d the segment's direction,   σ_angle = √2 sigma / length
/// with `sigma` that of an end across the segment; the angle is by both products, so no slope is singular. Fails where
/// the line passes through the eye.
class LineFactor final : public ceres::SizedCostFunction<2, kPoseSize, kLineSize, kRigSize> {
 public:
  /// `sigma`: normalised.
  LineFactor(const PairModel& pair, bool right, const SeenSegment& seen, double sigma);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const PairModel* pair_;
  bool right_;
  base::Vec3 middle_;
  base::Vec2 along_;
  double by_place_, by_angle_;  // inverse sigmas
};

/// The line block's manifold; Jacobians stand in the first four of five columns.
class LineManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kLineSize; }
  int TangentSize() const override { return kLineTangent; }
  bool Plus(const double* x, const double* delta, double* out) const override {
    LinePlus(x, delta, out);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 5, 4, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.topRows<4>().setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* out) const override;
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 4, 5, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.leftCols<4>().setIdentity();
    return true;
  }
};

}  // namespace alula::stack::estimation
