#include "stack/estimation/internal/linear_system.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace alula::stack::estimation {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VectorXd Difference(const LinearBlock& block) {
  if (block.kind == BlockKind::kPose) return PoseDifference(block.x, block.x0.data());
  const int n = AmbientSize(block.kind);
  return Eigen::Map<const VectorXd>(block.x, n) - Eigen::Map<const VectorXd>(block.x0.data(), n);
}

VectorXd LinearPrior::Residual() const {
  VectorXd d(J.cols());
  int column = 0;
  for (const LinearBlock& block : blocks) {
    const int n = TangentSize(block.kind);
    d.segment(column, n) = Difference(block);
    column += n;
  }
  return r + J * d;
}

int NormalEquations::AddBlock(double* x, BlockKind kind, const double* x0) {
  LinearBlock block{x, kind, {}};
  std::copy_n(x0 != nullptr ? x0 : x, AmbientSize(kind), block.x0.begin());
  blocks_.push_back(block);
  columns_.push_back(total_);
  total_ += TangentSize(kind);
  return static_cast<int>(blocks_.size()) - 1;
}

int NormalEquations::Find(const double* x) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i].x == x) return static_cast<int>(i);
  }
  return -1;
}

void NormalEquations::Allocate() {
  H_ = MatrixXd::Zero(total_, total_);
  b_ = VectorXd::Zero(total_);
}

void NormalEquations::Add(const LinearPrior& prior) {
  // d (x ⊟ x0) / dδ at the point about which this system is linearised; one where that is the prior's own.
  MatrixXd J = prior.J;
  int from_i = 0;
  for (const LinearBlock& block : prior.blocks) {
    const double* x0 = blocks_[static_cast<std::size_t>(Find(block.x))].x0.data();
    if (block.kind == BlockKind::kPose && !std::equal(x0, x0 + kPoseSize, block.x0.begin())) {
      const base::Vec3 turn = PoseDifference(x0, block.x0.data()).tail<3>();
      J.middleCols<3>(from_i + 3) = (J.middleCols<3>(from_i + 3) * base::RightJacobianInverse(turn)).eval();
    }
    from_i += TangentSize(block.kind);
  }
  const MatrixXd JtJ = J.transpose() * J;
  const VectorXd Jtr = J.transpose() * prior.Residual();
  from_i = 0;
  for (const LinearBlock& bi : prior.blocks) {
    const int ni = TangentSize(bi.kind), ci = Column(Find(bi.x));
    b_.segment(ci, ni) += Jtr.segment(from_i, ni);
    int from_j = 0;
    for (const LinearBlock& bj : prior.blocks) {
      const int nj = TangentSize(bj.kind), cj = Column(Find(bj.x));
      H_.block(ci, cj, ni, nj) += JtJ.block(from_i, from_j, ni, nj);
      from_j += nj;
    }
    from_i += ni;
  }
}

void NormalEquations::Add(const ceres::CostFunction& factor, std::span<const int> indices) {
  const int rows = factor.num_residuals();
  std::vector<const double*> here, there;
  std::vector<RowMajor> J;
  std::vector<double*> out;
  for (const int i : indices) {
    const LinearBlock& block = blocks_[static_cast<std::size_t>(i)];
    here.push_back(block.x);
    there.push_back(block.x0.data());
    J.emplace_back(rows, AmbientSize(block.kind));
  }
  for (RowMajor& m : J) out.push_back(m.data());
  VectorXd r(rows), unused(rows);
  if (!factor.Evaluate(there.data(), unused.data(), out.data())) return;
  if (!factor.Evaluate(here.data(), r.data(), nullptr)) return;
  for (std::size_t a = 0; a < indices.size(); ++a) {
    const int na = TangentSize(blocks_[static_cast<std::size_t>(indices[a])].kind), ca = Column(indices[a]);
    b_.segment(ca, na) += J[a].leftCols(na).transpose() * r;
    for (std::size_t c = 0; c < indices.size(); ++c) {
      const int nc = TangentSize(blocks_[static_cast<std::size_t>(indices[c])].kind), cc = Column(indices[c]);
      H_.block(ca, cc, na, nc) += J[a].leftCols(na).transpose() * J[c].leftCols(nc);
    }
  }
}

void NormalEquations::AddLandmark(const double* landmark, std::span<const Sight> sights, int rig, double huber) {
  struct Coupling {  // of one six-wide block with the landmark
    int block;
    Eigen::Matrix<double, 6, 3> H;
  };
  std::vector<Coupling> couplings;
  const auto coupling = [&couplings](int block) -> Eigen::Matrix<double, 6, 3>& {
    for (Coupling& c : couplings) {
      if (c.block == block) return c.H;
    }
    couplings.push_back({block, Eigen::Matrix<double, 6, 3>::Zero()});
    return couplings.back().H;
  };
  base::Mat3 H_l = base::Mat3::Zero();
  base::Vec3 b_l = base::Vec3::Zero();
  const int c_rig = Column(rig);
  LinearBlock& rig_block = blocks_[static_cast<std::size_t>(rig)];
  for (const Sight& sight : sights) {
    LinearBlock& pose = blocks_[static_cast<std::size_t>(sight.pose)];
    Eigen::Matrix<double, 2, 7, Eigen::RowMajor> J_pose;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> J_l;
    Eigen::Matrix<double, 2, 6, Eigen::RowMajor> J_rig;
    base::Vec2 r, unused;
    double* out[3] = {J_pose.data(), J_l.data(), J_rig.data()};
    const double* there[3] = {pose.x0.data(), landmark, rig_block.x0.data()};
    const double* here[3] = {pose.x, landmark, rig_block.x};
    if (!sight.factor->Evaluate(there, unused.data(), out) || !sight.factor->Evaluate(here, r.data(), nullptr))
      continue;
    // Huber: weight min(1, k/|r|) on the squared cost, first order.
    const double norm = r.norm();
    const double w = norm > huber ? huber / norm : 1.0;
    const Eigen::Matrix<double, 2, 6> J_p = J_pose.leftCols<6>();
    const int c_pose = Column(sight.pose);
    H_.block<6, 6>(c_pose, c_pose) += w * J_p.transpose() * J_p;
    H_.block<6, 6>(c_rig, c_rig) += w * J_rig.transpose() * J_rig;
    const base::Mat6 cross = w * J_p.transpose() * J_rig;
    H_.block<6, 6>(c_pose, c_rig) += cross;
    H_.block<6, 6>(c_rig, c_pose) += cross.transpose();
    b_.segment<6>(c_pose) += w * J_p.transpose() * r;
    b_.segment<6>(c_rig) += w * J_rig.transpose() * r;
    coupling(sight.pose) += w * J_p.transpose() * J_l;
    coupling(rig) += w * J_rig.transpose() * J_l;
    H_l += w * J_l.transpose() * J_l;
    b_l += w * J_l.transpose() * r;
  }
  if (couplings.empty()) return;
  // A landmark of unseen depth is held by 1e-11 of its lateral information: nothing else changes by that.
  H_l.diagonal().array() += 1e-11 * H_l.trace();
  const base::Mat3 inverse = H_l.inverse();
  for (const Coupling& a : couplings) {
    const Eigen::Matrix<double, 6, 3> K = a.H * inverse;
    const int ca = Column(a.block);
    b_.segment<6>(ca) -= K * b_l;
    for (const Coupling& c : couplings) H_.block<6, 6>(ca, Column(c.block)) -= K * c.H.transpose();
  }
}

LinearPrior Marginalise(const NormalEquations& system, int leading) {
  const int kept = system.columns() - leading;
  const MatrixXd& H = system.H();
  const VectorXd& b = system.b();
  MatrixXd H_mm = 0.5 * (H.topLeftCorner(leading, leading) + H.topLeftCorner(leading, leading).transpose());
  const Eigen::LDLT<MatrixXd> eliminate(H_mm);
  MatrixXd right(leading, kept + 1);
  right << H.topRightCorner(leading, kept), b.head(leading);
  const MatrixXd solved = eliminate.solve(right);
  const MatrixXd S = H.bottomRightCorner(kept, kept) - H.bottomLeftCorner(kept, leading) * solved.leftCols(kept);
  const VectorXd s = b.tail(kept) - H.bottomLeftCorner(kept, leading) * solved.col(kept);

  // S = Pᵀ L D Lᵀ P  →  J = √D Lᵀ P and r = D^(−½) L⁻¹ P s, so that JᵀJ = S and Jᵀr = s.
  const Eigen::LDLT<MatrixXd> root(0.5 * (S + S.transpose()));
  const VectorXd D = root.vectorD();
  const double least = 1e-14 * D.maxCoeff();
  // Transpositions are applied from the left alone: from the right Eigen 3.4 applies them in the wrong order.
  MatrixXd P = MatrixXd::Identity(kept, kept);
  P = root.transpositionsP() * P;
  MatrixXd J = root.matrixU() * P;
  VectorXd Ps = root.transpositionsP() * s;
  root.matrixL().solveInPlace(Ps);
  LinearPrior prior;
  prior.r = VectorXd::Zero(kept);
  for (int i = 0; i < kept; ++i) {
    const double scale = D[i] > least ? std::sqrt(D[i]) : 0.0;
    J.row(i) *= scale;
    prior.r[i] = scale > 0 ? Ps[i] / scale : 0.0;
  }
  prior.J = std::move(J);

  // The residual belongs to the current values; shift it to the linearisation points.
  VectorXd d(kept);
  for (std::size_t i = 0; i < system.blocks().size(); ++i) {
    const int column = system.Column(static_cast<int>(i)) - leading;
    if (column < 0) continue;
    prior.blocks.push_back(system.blocks()[i]);
    d.segment(column, TangentSize(prior.blocks.back().kind)) = Difference(prior.blocks.back());
  }
  prior.r -= prior.J * d;
  return prior;
}

MatrixXd MarginalCovariance(const MatrixXd& H, int first, int count) {
  const Eigen::LDLT<MatrixXd> ldlt(0.5 * (H + H.transpose()));
  MatrixXd unit = MatrixXd::Zero(H.rows(), count);
  unit.middleRows(first, count).setIdentity();
  return ldlt.solve(unit).middleRows(first, count);
}

}  // namespace alula::stack::estimation
