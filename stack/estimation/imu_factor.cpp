#include "stack/estimation/internal/imu_factor.h"

namespace alula::stack::estimation {

using base::Hat;
using base::Mat3;
using base::Transform;
using base::Vec3;

bool ImuFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const Transform X_i = PoseOf(parameters[0]), X_j = PoseOf(parameters[2]);
  const double *s_i = parameters[1], *s_j = parameters[3];
  const Vec3 v_i = Vec3At(s_i), g_i = Vec3At(s_i + 3), a_i = Vec3At(s_i + 6);
  const Vec3 v_j = Vec3At(s_j), g_j = Vec3At(s_j + 3), a_j = Vec3At(s_j + 6);
  const double dt = integral_->dt();
  const Vec3& gravity = gravity_;
  const ImuPreintegration::Corrected m = integral_->At(g_i, a_i);
  const Mat3 R_iT = X_i.R().transpose();
  const Vec3 dv = R_iT * (v_j - v_i - gravity * dt);
  const Vec3 dp = R_iT * (X_j.p - X_i.p - v_i * dt - 0.5 * gravity * dt * dt);
  const Vec3 rotation = base::Log(m.dR.conjugate() * (X_i.q.conjugate() * X_j.q));

  Vec15 r;
  r << rotation, dv - m.dv, dp - m.dp, g_j - g_i, a_j - a_i;
  Eigen::Map<Vec15>{residuals} = W_ * r;
  if (jacobians == nullptr) return true;

  const Mat3 Jr_inverse = base::RightJacobianInverse(rotation);
  const Mat15& J = integral_->jacobian();
  if (jacobians[0] != nullptr) {
    Eigen::Matrix<double, 15, 7> D = Eigen::Matrix<double, 15, 7>::Zero();
    D.block<3, 3>(0, 3) = -Jr_inverse * (X_j.q.conjugate() * X_i.q).toRotationMatrix();
    D.block<3, 3>(3, 3) = Hat(dv);
    D.block<3, 3>(6, 0) = -R_iT;
    D.block<3, 3>(6, 3) = Hat(dp);
    Eigen::Map<Eigen::Matrix<double, 15, 7, Eigen::RowMajor>>{jacobians[0]} = W_ * D;
  }
  if (jacobians[1] != nullptr) {
    Eigen::Matrix<double, 15, 9> D = Eigen::Matrix<double, 15, 9>::Zero();
    const Mat3 by_bias = J.block<3, 3>(0, 9);
    const Vec3 shift = by_bias * (g_i - integral_->gyro_bias());
    D.block<3, 3>(0, 3) =
        -Jr_inverse * base::Exp(rotation).toRotationMatrix().transpose() * base::RightJacobian(shift) * by_bias;
    D.block<3, 3>(3, 0) = -R_iT;
    D.block<3, 3>(3, 3) = -J.block<3, 3>(3, 9);
    D.block<3, 3>(3, 6) = -J.block<3, 3>(3, 12);
    D.block<3, 3>(6, 0) = -R_iT * dt;
    D.block<3, 3>(6, 3) = -J.block<3, 3>(6, 9);
    D.block<3, 3>(6, 6) = -J.block<3, 3>(6, 12);
    D.block<6, 6>(9, 3) = -base::Mat6::Identity();
    Eigen::Map<Eigen::Matrix<double, 15, 9, Eigen::RowMajor>>{jacobians[1]} = W_ * D;
  }
  if (jacobians[2] != nullptr) {
    Eigen::Matrix<double, 15, 7> D = Eigen::Matrix<double, 15, 7>::Zero();
    D.block<3, 3>(0, 3) = Jr_inverse;
    D.block<3, 3>(6, 0) = R_iT;
    Eigen::Map<Eigen::Matrix<double, 15, 7, Eigen::RowMajor>>{jacobians[2]} = W_ * D;
  }
  if (jacobians[3] != nullptr) {
    Eigen::Matrix<double, 15, 9> D = Eigen::Matrix<double, 15, 9>::Zero();
    D.block<3, 3>(3, 0) = R_iT;
    D.block<6, 6>(9, 3) = base::Mat6::Identity();
    Eigen::Map<Eigen::Matrix<double, 15, 9, Eigen::RowMajor>>{jacobians[3]} = W_ * D;
  }
  return true;
}

}  // namespace alula::stack::estimation
