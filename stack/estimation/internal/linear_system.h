#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "stack/estimation/internal/parameters.h"

namespace alula::stack::estimation {

enum class BlockKind { kPose, kSpeedBias, kRig };
constexpr int AmbientSize(BlockKind k) {
  return k == BlockKind::kPose ? kPoseSize : k == BlockKind::kRig ? kRigSize : kSpeedBiasSize;
}
constexpr int TangentSize(BlockKind k) { return k == BlockKind::kSpeedBias ? kSpeedBiasSize : 6; }

/// A parameter block with the point about which it is linearised: where it was when it first entered a prior (first
/// estimate Jacobians: Huang et al. 2010; otherwise the prior would gain information on directions that cannot be
/// seen, such as heading), else where it is.
struct LinearBlock {
  double* x = nullptr;
  BlockKind kind = BlockKind::kPose;
  std::array<double, 9> x0{};
};

/// x ⊟ x0 of a block, in its tangent.
Eigen::VectorXd Difference(const LinearBlock& block);

/// A Gaussian on some blocks: cost ½ |r + J (x ⊟ x0)|².
struct LinearPrior {
  std::vector<LinearBlock> blocks;
  Eigen::MatrixXd J;  // rows × sum of tangents
  Eigen::VectorXd r;

  Eigen::VectorXd Residual() const;
};

/// Gauss–Newton's normal equations H δ = −b over some blocks, in the order in which they were added; landmarks are
/// eliminated as they come (Schur complement), so that they never take columns. Residuals are taken at the current
/// values, Jacobians at the blocks' linearisation points.
class NormalEquations {
 public:
  /// Returns the index of the block. `x0` null: linearised where it stands.
  int AddBlock(double* x, BlockKind kind, const double* x0 = nullptr);
  int Find(const double* x) const;  // −1 where absent

  /// A prior whose blocks are linearised elsewhere is turned to where they are linearised here.
  void Add(const LinearPrior& prior);
  /// A factor on the blocks of these indices, in the factor's order.
  void Add(const ceres::CostFunction& factor, std::span<const int> blocks);

  /// One reprojection: a 2-row factor on (pose, landmark, rig).
  struct Sight {
    const ceres::CostFunction* factor = nullptr;
    int pose = 0;
  };
  /// All reprojections of one landmark, with a Huber kernel of width `huber`; the landmark is eliminated. Sights that
  /// cannot be evaluated are left out.
  void AddLandmark(const double* landmark, std::span<const Sight> sights, int rig, double huber);

  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::VectorXd& b() const { return b_; }
  const std::vector<LinearBlock>& blocks() const { return blocks_; }
  int Column(int block) const { return columns_[static_cast<std::size_t>(block)]; }
  int columns() const { return total_; }
  /// To be called after the last AddBlock and before the first Add.
  void Allocate();

 private:
  std::vector<LinearBlock> blocks_;
  std::vector<int> columns_;
  int total_ = 0;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
};

/// Marginalises the first `leading` columns: Schur complement onto the others, and its square root as a prior on the
/// blocks that these columns belong to. Directions without information get no row.
LinearPrior Marginalise(const NormalEquations& system, int leading);

/// Covariance of the tangent columns [first, first + count): that block of H⁻¹.
Eigen::MatrixXd MarginalCovariance(const Eigen::MatrixXd& H, int first, int count);

}  // namespace alula::stack::estimation
