#pragma once

#include <Eigen/Core>
#include <vector>

namespace alula::stack::slam {

/// Symmetric blocks of 6×6 over poses and a right side: H δ = −b. Small systems are kept and solved densely, large ones
/// by their blocks alone.
class ReducedSystem {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;

  explicit ReducedSystem(int poses);
  void SetZero();
  /// Adds to block (i, j), i ≤ j; of diagonal blocks the upper triangle counts.
  Block& At(int i, int j);
  Eigen::VectorXd& b() { return b_; }
  const Eigen::VectorXd& b() const { return b_; }
  /// δ with the diagonal multiplied by 1 + lambda; false where the matrix is not positive definite.
  bool Solve(double lambda, Eigen::VectorXd& delta) const;

 private:
  bool SolveDense(double lambda, Eigen::VectorXd& delta) const;
  bool SolveSparse(double lambda, Eigen::VectorXd& delta) const;

  static constexpr int kDenseUpTo = 250;  // poses: 1500 columns, 1 GFLOP

  int poses_;
  bool dense_;
  std::vector<int> index_;                              // dense: of block (i, j) at i · poses + j; −1: none yet
  std::vector<std::vector<std::pair<int, int>>> rows_;  // sparse: of row i, (column, index)
  std::vector<Block, Eigen::aligned_allocator<Block>> blocks_;
  Eigen::VectorXd b_;
};

}  // namespace alula::stack::slam
