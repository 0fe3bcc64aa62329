#include "stack/estimation/internal/reprojection_factor.h"

#include <algorithm>

namespace alula::stack::estimation {

using base::Exp;
using base::Mat3;
using base::Quat;
using base::Transform;
using base::Vec3;

const PairModel::Geometry& PairModel::At(const double* pose, const double* rig) const {
  Geometry& g = geometry_;
  if (g.valid && std::equal(pose, pose + kPoseSize, g.parameters.begin()) &&
      std::equal(rig, rig + kRigSize, g.parameters.begin() + kPoseSize)) {
    return g;
  }
  std::copy_n(pose, kPoseSize, g.parameters.begin());
  std::copy_n(rig, kRigSize, g.parameters.begin() + kPoseSize);
  const Transform X_OI = PoseOf(pose);
  const Vec3 theta = Vec3At(rig), psi(rig[3], rig[4], 0.0);
  const double t = rig[5];
  const Mat3 turn = Exp(w_I * t).toRotationMatrix();
  const Quat eye = Exp(psi).conjugate();
  g.turn_T = turn.transpose();
  g.R_IO = (X_OI.R() * turn).transpose();
  g.p_OI = X_OI.p + v_OI * t;
  g.R_LI = (X_IC.q * Exp(theta)).conjugate().toRotationMatrix();
  g.p_IL = X_IC.p;
  g.R_RL = (eye * X_RL.q).toRotationMatrix();
  g.p_RL = eye * X_RL.p;
  g.J_theta = base::RightJacobian(theta);
  g.J_psi = base::RightJacobian(psi);
  g.valid = true;
  return g;
}

bool ReprojectionFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  constexpr double kNearest = 0.05;  // m
  const PairModel::Geometry& g = pair_->At(parameters[0], parameters[2]);
  const Vec3 p_I = g.R_IO * (Vec3At(parameters[1]) - g.p_OI);
  const Vec3 p_L = g.R_LI * (p_I - g.p_IL);
  const Vec3 p_C = right_ ? Vec3(g.R_RL * p_L + g.p_RL) : p_L;
  if (p_C.z() < kNearest) return false;
  const double z_inverse = 1.0 / p_C.z();
  const base::Vec2 projected = p_C.head<2>() * z_inverse;
  Eigen::Map<base::Vec2>{residuals} = pair_->weight * (projected - seen_);
  if (jacobians == nullptr) return true;

  using Mat23 = Eigen::Matrix<double, 2, 3>;
  const double w = pair_->weight * z_inverse;
  Mat23 by_C;
  by_C << w, 0, -projected.x() * w, 0, w, -projected.y() * w;
  Mat23 by_L = by_C;
  if (right_) by_L = by_C * g.R_RL;
  const Mat23 by_I = by_L * g.R_LI;
  const Mat23 by_O = by_I * g.R_IO;
  // Rows times Hat(p) are cross products: aᵀ [p]× = (a × p)ᵀ.
  const auto times_hat = [](const Mat23& rows, const Vec3& p) {
    Mat23 out;
    out << rows(0, 1) * p.z() - rows(0, 2) * p.y(), rows(0, 2) * p.x() - rows(0, 0) * p.z(),
        rows(0, 0) * p.y() - rows(0, 1) * p.x(), rows(1, 1) * p.z() - rows(1, 2) * p.y(),
        rows(1, 2) * p.x() - rows(1, 0) * p.z(), rows(1, 0) * p.y() - rows(1, 1) * p.x();
    return out;
  };
  const Mat23 by_turn = times_hat(by_I, p_I);
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> J(jacobians[0]);
    J.leftCols<3>() = -by_O;
    J.middleCols<3>(3) = by_turn * g.turn_T;
    J.col(6).setZero();
  }
  if (jacobians[1] != nullptr) Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{jacobians[1]} = by_O;
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> J(jacobians[2]);
    J.leftCols<3>() = times_hat(by_L, p_L) * g.J_theta;
    J.middleCols<2>(3).setZero();
    if (right_) J.middleCols<2>(3) = (times_hat(by_C, p_C) * g.J_psi).leftCols<2>();
    J.col(5) = by_turn * pair_->w_I - by_O * pair_->v_OI;
  }
  return true;
}

}  // namespace alula::stack::estimation
