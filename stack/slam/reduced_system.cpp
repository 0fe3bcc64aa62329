#include "stack/slam/internal/reduced_system.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>

namespace alula::stack::slam {

ReducedSystem::ReducedSystem(int poses)
    : poses_(poses), dense_(poses <= kDenseUpTo), b_(Eigen::VectorXd::Zero(6 * poses)) {
  if (dense_) {
    index_.assign(static_cast<std::size_t>(poses) * static_cast<std::size_t>(poses), -1);
  }
  rows_.resize(static_cast<std::size_t>(poses));
}

void ReducedSystem::SetZero() {
  for (Block& block : blocks_) block.setZero();
  b_.setZero();
}

ReducedSystem::Block& ReducedSystem::At(int i, int j) {
  auto& row = rows_[static_cast<std::size_t>(i)];
  int* known = nullptr;
  if (dense_) {
    known = &index_[static_cast<std::size_t>(i) * static_cast<std::size_t>(poses_) + static_cast<std::size_t>(j)];
    if (*known >= 0) return blocks_[static_cast<std::size_t>(*known)];
  }
  auto at = row.end();
  if (!dense_) {
    at = std::lower_bound(row.begin(), row.end(), std::pair(j, -1));
    if (at != row.end() && at->first == j) return blocks_[static_cast<std::size_t>(at->second)];
  }
  const int index = static_cast<int>(blocks_.size());
  blocks_.emplace_back(Block::Zero());
  row.insert(at, {j, index});
  if (known != nullptr) *known = index;
  return blocks_.back();
}

bool ReducedSystem::Solve(double lambda, Eigen::VectorXd& delta) const {
  return dense_ ? SolveDense(lambda, delta) : SolveSparse(lambda, delta);
}

bool ReducedSystem::SolveDense(double lambda, Eigen::VectorXd& delta) const {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(6 * poses_, 6 * poses_);
  for (int i = 0; i < poses_; ++i) {
    for (const auto& [j, index] : rows_[static_cast<std::size_t>(i)]) {
      lower.block<6, 6>(6 * j, 6 * i) = blocks_[static_cast<std::size_t>(index)].transpose();
    }
  }
  lower.diagonal() *= 1.0 + lambda;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> llt(lower);
  if (llt.info() != Eigen::Success) return false;
  delta = llt.solve(-b_);
  return delta.allFinite();
}

bool ReducedSystem::SolveSparse(double lambda, Eigen::VectorXd& delta) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(blocks_.size() * 36);
  for (int i = 0; i < poses_; ++i) {
    for (const auto& [j, index] : rows_[static_cast<std::size_t>(i)]) {
      const Block& block = blocks_[static_cast<std::size_t>(index)];
      for (int r = 0; r < 6; ++r) {
        for (int c = i == j ? r : 0; c < 6; ++c) {
          const double scale = i == j && r == c ? 1.0 + lambda : 1.0;
          entries.emplace_back(6 * j + c, 6 * i + r, scale * block(r, c));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> lower(6 * poses_, 6 * poses_);
  lower.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt(lower);
  if (llt.info() != Eigen::Success) return false;
  delta = llt.solve(-b_);
  return delta.allFinite();
}

}  // namespace alula::stack::slam
