#pragma once

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "stack/estimation/internal/linear_system.h"

namespace alula::stack::estimation::test {

/// A parameter block by value.
struct TestBlock {
  BlockKind kind = BlockKind::kPose;
  bool landmark = false;
  std::vector<double> x;
  int tangent() const { return landmark ? 3 : TangentSize(kind); }
};

inline std::vector<double> Moved(const TestBlock& block, int axis, double by) {
  std::vector<double> moved = block.x;
  if (!block.landmark && block.kind == BlockKind::kPose) {
    double delta[6] = {};
    delta[axis] = by;
    PosePlus(block.x.data(), delta, moved.data());
  } else {
    moved[static_cast<std::size_t>(axis)] += by;
  }
  return moved;
}

/// Compares each Jacobian with central differences over the tangent. `tolerance` is relative to the largest entry;
/// central differences with a step h are good to h² plus rounding / h.
inline void ExpectJacobians(const ceres::CostFunction& factor, std::vector<TestBlock> blocks, double tolerance = 1e-6,
                            double step = 1e-5) {
  const int rows = factor.num_residuals();
  const auto residual = [&](const std::vector<TestBlock>& at) {
    std::vector<const double*> x;
    for (const TestBlock& b : at) x.push_back(b.x.data());
    Eigen::VectorXd r(rows);
    EXPECT_TRUE(factor.Evaluate(x.data(), r.data(), nullptr));
    return r;
  };
  std::vector<const double*> x;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J;
  std::vector<double*> out;
  for (const TestBlock& b : blocks) {
    x.push_back(b.x.data());
    J.emplace_back(rows, static_cast<Eigen::Index>(b.x.size()));
  }
  for (auto& m : J) out.push_back(m.data());
  Eigen::VectorXd r(rows);
  ASSERT_TRUE(factor.Evaluate(x.data(), r.data(), out.data()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const int n = blocks[b].tangent();
    Eigen::MatrixXd numeric(rows, n);
    for (int axis = 0; axis < n; ++axis) {
      std::vector<TestBlock> plus = blocks, minus = blocks;
      plus[b].x = Moved(blocks[b], axis, step);
      minus[b].x = Moved(blocks[b], axis, -step);
      numeric.col(axis) = (residual(plus) - residual(minus)) / (2 * step);
    }
    const double scale = std::max(1.0, numeric.cwiseAbs().maxCoeff());
    EXPECT_LT((J[b].leftCols(n) - numeric).cwiseAbs().maxCoeff() / scale, tolerance)
        << "block " << b << "\nanalytic\n"
        << J[b].leftCols(n) << "\nnumeric\n"
        << numeric;
  }
}

inline TestBlock PoseBlock(const base::Transform& X) {
  TestBlock b;
  b.x.resize(7);
  SetPose(X, b.x.data());
  return b;
}
inline TestBlock VectorBlock(BlockKind kind, const Eigen::VectorXd& x) {
  return {kind, false, std::vector<double>(x.data(), x.data() + x.size())};
}
inline TestBlock LandmarkBlock(const base::Vec3& p) { return {BlockKind::kRig, true, {p.x(), p.y(), p.z()}}; }

}  // namespace alula::stack::estimation::test
