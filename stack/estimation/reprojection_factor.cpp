#include "stack/estimation/internal/reprojection_factor.h"

namespace alula::stack::estimation {

using base::Exp;
using base::Hat;
using base::Mat3;
using base::Quat;
using base::Transform;
using base::Vec3;

bool ReprojectionFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  constexpr double kNearest = 0.05;  // m
  const Transform X_OI = PoseOf(parameters[0]);
  const Vec3 p_O = Vec3At(parameters[1]);
  const double* rig = parameters[2];
  const Vec3 theta = Vec3At(rig), psi(rig[3], rig[4], 0.0);
  const double t = rig[5];

  const Mat3 turn = Exp(pair_->w_I * t).toRotationMatrix();  // of the IMU during the time offset
  const Mat3 R_O = (X_OI.R() * turn).transpose();            // O → I at the exposure
  const Vec3 p_I = R_O * (p_O - X_OI.p - pair_->v_OI * t);
  const Mat3 R_LI = (pair_->X_IC.q * Exp(theta)).conjugate().toRotationMatrix();
  const Vec3 p_L = R_LI * (p_I - pair_->X_IC.p);
  Vec3 p_C = p_L;
  Mat3 R_CL = Mat3::Identity();
  if (right_) {
    R_CL = (Exp(psi).conjugate() * pair_->X_RL.q).toRotationMatrix();
    p_C = R_CL * p_L + Exp(psi).conjugate() * pair_->X_RL.p;
  }
  if (p_C.z() < kNearest) return false;
  const double z_inverse = 1.0 / p_C.z();
  const base::Vec2 projected = p_C.head<2>() * z_inverse;
  Eigen::Map<base::Vec2>{residuals} = pair_->weight * (projected - seen_);
  if (jacobians == nullptr) return true;

  Eigen::Matrix<double, 2, 3> by_C;
  by_C << z_inverse, 0, -projected.x() * z_inverse, 0, z_inverse, -projected.y() * z_inverse;
  by_C *= pair_->weight;
  const Eigen::Matrix<double, 2, 3> by_L = by_C * R_CL;
  const Eigen::Matrix<double, 2, 3> by_I = by_L * R_LI;
  const Eigen::Matrix<double, 2, 3> by_O = by_I * R_O;
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> J(jacobians[0]);
    J.leftCols<3>() = -by_O;
    J.middleCols<3>(3) = by_I * Hat(p_I) * turn.transpose();
    J.col(6).setZero();
  }
  if (jacobians[1] != nullptr) Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{jacobians[1]} = by_O;
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> J(jacobians[2]);
    J.leftCols<3>() = by_L * Hat(p_L) * base::RightJacobian(theta);
    J.middleCols<2>(3).setZero();
    if (right_) J.middleCols<2>(3) = by_C * (Hat(p_C) * base::RightJacobian(psi)).leftCols<2>();
    J.col(5) = by_I * (Hat(p_I) * pair_->w_I) - by_O * pair_->v_OI;
  }
  return true;
}

}  // namespace alula::stack::estimation
