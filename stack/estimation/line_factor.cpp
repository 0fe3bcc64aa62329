#include "stack/estimation/internal/line_factor.h"

#include <cmath>

namespace alula::stack::estimation {

using base::Hat;
using base::Mat3;
using base::Vec2;
using base::Vec3;

LineFactor::LineFactor(const PairModel& pair, bool right, const SeenSegment& seen, double sigma)
    : pair_(&pair),
      right_(right),
      middle_((0.5 * (seen.a + seen.b)).homogeneous()),
      along_((seen.b - seen.a).normalized()),
      by_place_(std::sqrt(2.0) / sigma),
      by_angle_((seen.b - seen.a).norm() / (std::sqrt(2.0) * sigma)) {}

bool LineFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const PairModel::Geometry& g = pair_->At(parameters[0], parameters[2]);
  const PluckerLine line = LineAt(parameters[1]);
  // Into each frame by a shift (the moment about the new origin) and a turn.
  const Vec3 n_I = g.R_IO * (line.n - g.p_OI.cross(line.v)), v_I = g.R_IO * line.v;
  const Vec3 n_L = g.R_LI * (n_I - g.p_IL.cross(v_I)), v_L = g.R_LI * v_I;
  const Vec3 n = right_ ? Vec3(g.R_RL * n_L + g.p_RL.cross(g.R_RL * v_L)) : n_L;
  const double square = n.head<2>().squaredNorm(), norm = std::sqrt(square);
  if (!(norm > 1e-9 * line.v.norm())) return false;
  const double place = middle_.dot(n) / norm;
  // Points m on the line satisfy mᵀ n = 0; along it (n × e_z) = (n_y, −n_x), with v's sense: the line's points run from
  // x to x + v, whose images move along this where (x × v) · … is n itself.
  const Vec2 d(n.y(), -n.x());
  const double cross = along_.x() * d.y() - along_.y() * d.x(), dot = along_.dot(d);
  residuals[0] = by_place_ * place;
  residuals[1] = by_angle_ * std::atan2(cross, dot);
  if (jacobians == nullptr) return true;

  Eigen::Matrix<double, 2, 3> by_n;
  const Vec2 unit = n.head<2>() / norm;
  by_n.row(0) = by_place_ / norm * (middle_.transpose() - Eigen::RowVector3d(place * unit.x(), place * unit.y(), 0.0));
  // The angle of d = (n_y, −n_x): δ = (d_x δd_y − d_y δd_x) / |d|² = (−n_y δn_x + n_x δn_y) / |n_xy|².
  by_n.row(1) = by_angle_ / square * Eigen::RowVector3d(-n.y(), n.x(), 0.0);
  Eigen::Matrix<double, 2, 3> by_n_L = by_n, by_v_L = Eigen::Matrix<double, 2, 3>::Zero();
  if (right_) {
    by_n_L = by_n * g.R_RL;
    by_v_L = by_n * Hat(g.p_RL) * g.R_RL;
  }
  const Eigen::Matrix<double, 2, 3> by_n_I = by_n_L * g.R_LI;
  const Eigen::Matrix<double, 2, 3> by_v_I = by_v_L * g.R_LI - by_n_I * Hat(g.p_IL);
  const Eigen::Matrix<double, 2, 3> by_turn = by_n_I * Hat(n_I) + by_v_I * Hat(v_I);  // of the IMU at the exposure
  const Eigen::Matrix<double, 2, 3> by_shift = by_n_I * g.R_IO * Hat(line.v);         // of its place in O
  if (jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> J(jacobians[0]);
    J.leftCols<3>() = by_shift;
    J.middleCols<3>(3) = by_turn * g.turn_T;
    J.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    Mat34 n_by, v_by;
    LineJacobians(parameters[1], n_by, v_by);
    Eigen::Map<Eigen::Matrix<double, 2, 5, Eigen::RowMajor>> J(jacobians[1]);
    J.leftCols<4>() = by_n_I * g.R_IO * (n_by - Hat(g.p_OI) * v_by) + by_v_I * g.R_IO * v_by;
    J.col(4).setZero();
  }
  if (jacobians[2] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> J(jacobians[2]);
    J.leftCols<3>() = (by_n_L * Hat(n_L) + by_v_L * Hat(v_L)) * g.J_theta;
    J.middleCols<2>(3).setZero();
    if (right_) J.middleCols<2>(3) = (by_n * Hat(n) * g.J_psi).leftCols<2>();
    J.col(5) = by_turn * pair_->w_I + by_shift * pair_->v_OI;
  }
  return true;
}

bool LineManifold::Minus(const double* y, const double* x, double* out) const {
  const base::Quat a(x[3], x[0], x[1], x[2]), b(y[3], y[0], y[1], y[2]);
  const Vec3 d = base::Log(a.conjugate() * b);
  out[0] = d.x(), out[1] = d.y(), out[2] = d.z(), out[3] = y[4] - x[4];
  return true;
}

}  // namespace alula::stack::estimation
