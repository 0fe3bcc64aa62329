#include "stack/estimation/internal/prior_factor.h"

namespace alula::stack::estimation {

PriorFactor::PriorFactor(const LinearPrior& prior) : prior_(&prior) {
  for (const LinearBlock& block : prior.blocks) mutable_parameter_block_sizes()->push_back(AmbientSize(block.kind));
  set_num_residuals(static_cast<int>(prior.J.rows()));
}

bool PriorFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const int rows = num_residuals();
  Eigen::Map<Eigen::VectorXd> r(residuals, rows);
  Eigen::VectorXd d(prior_->J.cols());
  int column = 0;
  for (std::size_t i = 0; i < prior_->blocks.size(); ++i) {
    const LinearBlock& block = prior_->blocks[i];
    const int n = TangentSize(block.kind), ambient = AmbientSize(block.kind);
    if (block.kind == BlockKind::kPose) {
      d.segment(column, n) = PoseDifference(parameters[i], block.x0.data());
    } else {
      d.segment(column, n) = Eigen::Map<const Eigen::VectorXd>(parameters[i], ambient) -
                             Eigen::Map<const Eigen::VectorXd>(block.x0.data(), ambient);
    }
    if (jacobians != nullptr && jacobians[i] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(jacobians[i], rows, ambient);
      J.leftCols(n) = prior_->J.middleCols(column, n);
      // d Log(q0⁻¹ q Exp(δ)) / dδ = J_r⁻¹.
      if (block.kind == BlockKind::kPose) {
        J.rightCols(1).setZero();
        const base::Vec3 turn = d.segment<3>(column + 3);
        J.middleCols<3>(3) = prior_->J.middleCols<3>(column + 3) * base::RightJacobianInverse(turn);
      }
    }
    column += n;
  }
  r = prior_->r + prior_->J * d;
  return true;
}

}  // namespace alula::stack::estimation
