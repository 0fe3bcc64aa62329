#include "stack/slam/internal/bundle_residuals.h"

namespace alula::stack::slam {

using base::Mat3;
using base::Mat6;
using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;

namespace {

constexpr double kNearest = 0.05;  // m: nearer to an eye nothing is seen

Eigen::Matrix<double, 2, 3> ProjectionJacobian(const Vec3& p, const Vec2& projected) {
  const double z = 1.0 / p.z();
  Eigen::Matrix<double, 2, 3> J;
  J << z, 0, -projected.x() * z, 0, z, -projected.y() * z;
  return J;
}

}  // namespace

View ViewFrom(const Transform& X_MB, const Eyes& eyes) {
  View view;
  const Transform X_LB = eyes.X_BL.Inverse(), X_LM = X_LB * X_MB.Inverse();
  view.R_LM = X_LM.R();
  view.p_LM = X_LM.p;
  view.R_LB = X_LB.R();
  if (eyes.X_LR) {
    const Transform X_RL = eyes.X_LR->Inverse();
    view.R_RL = X_RL.R();
    view.p_RL = X_RL.p;
  }
  return view;
}

bool SightResidual(const View& view, const Sight& sight, const Vec3& p_M, Vec3& r, Mat3* by_L) {
  const Vec3 p_L = view.R_LM * p_M + view.p_LM;
  if (p_L.z() < kNearest) return false;
  const double w = 1.0 / sight.sigma;
  const Vec2 left = p_L.head<2>() / p_L.z();
  r.head<2>() = w * (left - sight.left);
  r.z() = 0.0;
  if (by_L != nullptr) {
    by_L->topRows<2>() = w * ProjectionJacobian(p_L, left);
    by_L->row(2).setZero();
  }
  if (!sight.right) return true;
  const Vec3 p_R = view.R_RL * p_L + view.p_RL;
  if (p_R.z() < kNearest) return false;
  const Vec2 right = p_R.head<2>() / p_R.z();
  const Eigen::Matrix<double, 2, 3> J = ProjectionJacobian(p_R, right);
  // Along the epipolar line the projection moves with depth: d(right)/d(depth) with the left ray held.
  const Vec2 along = (J * (view.R_RL * p_L)).normalized();
  r.z() = w * along.dot(right - *sight.right);
  if (by_L != nullptr) by_L->row(2) = w * along.transpose() * J * view.R_RL;
  return true;
}

Mat36 ByPose(const Mat3& by_L, const View& view, const Transform& X_MB, const Vec3& p_M) {
  const Vec3 p_B = X_MB.q.conjugate() * (p_M - X_MB.p);
  Mat36 J;
  J.leftCols<3>() = -by_L * view.R_LM;
  J.rightCols<3>() = by_L * view.R_LB * base::Hat(p_B);
  return J;
}

Vec6 MotionResidual(const Transform& X_MF, const Transform& X_MT, const RelativeMotion& motion) {
  Vec6 r;
  r.head<3>() = X_MF.q.conjugate() * (X_MT.p - X_MF.p) - motion.X_FT.p;
  r.tail<3>() = base::Log(motion.X_FT.q.conjugate() * X_MF.q.conjugate() * X_MT.q);
  return r.cwiseQuotient(motion.sigma);
}

void MotionJacobians(const Transform& X_MF, const Transform& X_MT, const RelativeMotion& motion, Mat6& by_F,
                     Mat6& by_T) {
  const Mat3 R_FM = X_MF.q.conjugate().toRotationMatrix(), R_TF = (X_MT.q.conjugate() * X_MF.q).toRotationMatrix();
  const Mat3 J_log = base::RightJacobianInverse(base::Log(motion.X_FT.q.conjugate() * X_MF.q.conjugate() * X_MT.q));
  by_F.setZero();
  by_T.setZero();
  by_F.topLeftCorner<3, 3>() = -R_FM;
  by_F.topRightCorner<3, 3>() = base::Hat(R_FM * (X_MT.p - X_MF.p));
  by_F.bottomRightCorner<3, 3>() = -J_log * R_TF;
  by_T.topLeftCorner<3, 3>() = R_FM;
  by_T.bottomRightCorner<3, 3>() = J_log;
  by_F = motion.sigma.cwiseInverse().asDiagonal() * by_F;
  by_T = motion.sigma.cwiseInverse().asDiagonal() * by_T;
}

Vec3 VerticalResidual(const Transform& X_MB, const Vertical& vertical) {
  return (X_MB.q.conjugate() * Vec3::UnitZ() - vertical.up_B) / vertical.sigma;
}

Mat3 VerticalJacobian(const Transform& X_MB, const Vertical& vertical) {
  return base::Hat(X_MB.q.conjugate() * Vec3::UnitZ()) / vertical.sigma;  // Exp(−δθ) u = u + [u]× δθ
}

std::optional<Vec3> ResidualOf(const Transform& X_MB, const Eyes& eyes, const Sight& sight, const Vec3& p_M) {
  Vec3 r;
  if (!SightResidual(ViewFrom(X_MB, eyes), sight, p_M, r, nullptr)) return std::nullopt;
  return r;
}

}  // namespace alula::stack::slam
