#pragma once

#include <ceres/manifold.h>

#include "stack/estimation/internal/parameters.h"

namespace alula::stack::estimation {

/// The pose block's manifold. The factors of this folder write their Jacobians with respect to the 6-vector of the
/// tangent into the first six columns of seven and zero into the last; PlusJacobian = [I; 0] passes them through.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kPoseSize; }
  int TangentSize() const override { return kPoseTangent; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    PosePlus(x, delta, x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.topRows<6>().setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<base::Vec6> d(y_minus_x);
    d = PoseDifference(y, x);
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.leftCols<6>().setIdentity();
    return true;
  }
};

}  // namespace alula::stack::estimation
