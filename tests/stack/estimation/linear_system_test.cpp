#include "stack/estimation/internal/linear_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <memory>

#include "base/random.h"
#include "stack/estimation/internal/reprojection_factor.h"

namespace alula::stack::estimation::test {
namespace {

using base::Exp;
using base::Vec3;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Three poses, a rig, twelve landmarks seen by all in both eyes, and a prior on all blocks.
struct Scene {
  std::vector<std::array<double, 7>> poses{3};
  std::array<double, 6> rig{};
  std::vector<std::array<double, 3>> points{12};
  PairModel pair;
  std::vector<std::vector<std::unique_ptr<ReprojectionFactor>>> factors;  // [point][pose × eye]
  LinearPrior prior;

  explicit Scene(double huge_error = 0.0) {
    base::RandomStream random(11, "test/linear_system");
    pair.X_IC = {base::ForwardCameraRotation(), Vec3(0.1, 0, 0)};
    pair.X_RL = {base::Quat::Identity(), Vec3(-0.11, 0, 0)};
    pair.weight = 381.0;
    for (auto& p : poses) SetPose({Exp(0.1 * random.GaussianVec3()), 0.3 * random.GaussianVec3()}, p.data());
    for (double& x : rig) x = 0.002 * random.Gaussian();
    for (auto& p : points) p = {random.Uniform(4, 9), random.Uniform(-2, 2), random.Uniform(-2, 2)};
    for (std::size_t l = 0; l < points.size(); ++l) {
      factors.emplace_back();
      for (std::size_t k = 0; k < 6; ++k) {
        base::Vec2 r;
        const double* x[3] = {poses[k / 2].data(), points[l].data(), rig.data()};
        const ReprojectionFactor exact(pair, k % 2 == 1, base::Vec2::Zero());
        EXPECT_TRUE(exact.Evaluate(x, r.data(), nullptr));
        const double error = (l == 0 ? huge_error : 0.0) + 1e-3 * random.Gaussian();
        const base::Vec2 seen = r / pair.weight + base::Vec2(error, 1e-3 * random.Gaussian());
        factors.back().push_back(std::make_unique<ReprojectionFactor>(pair, k % 2 == 1, seen));
      }
    }
    const auto add = [this](double* x, BlockKind kind) {
      LinearBlock b{x, kind, {}};
      std::copy_n(x, AmbientSize(kind), b.x0.begin());
      prior.blocks.push_back(b);
    };
    for (auto& p : poses) add(p.data(), BlockKind::kPose);
    add(rig.data(), BlockKind::kRig);
    prior.J = 10.0 * MatrixXd::Identity(24, 24);
    prior.r = VectorXd::Constant(24, 0.1);
  }

  NormalEquations Assemble(double huber) {
    NormalEquations system;
    for (auto& p : poses) system.AddBlock(p.data(), BlockKind::kPose);
    const int rig_block = system.AddBlock(rig.data(), BlockKind::kRig);
    system.Allocate();
    system.Add(prior);
    for (std::size_t l = 0; l < points.size(); ++l) {
      std::vector<NormalEquations::Sight> sights;
      for (std::size_t k = 0; k < 6; ++k) sights.push_back({factors[l][k].get(), static_cast<int>(k / 2)});
      system.AddLandmark(points[l].data(), sights, rig_block, huber);
    }
    return system;
  }

  /// All of it dense: columns poses (18), rig (6), landmarks (36).
  std::pair<MatrixXd, VectorXd> BruteForce(double huber) const {
    const int n = 24 + 3 * static_cast<int>(points.size());
    MatrixXd H = MatrixXd::Zero(n, n);
    VectorXd b = VectorXd::Zero(n);
    H.topLeftCorner(24, 24) = prior.J.transpose() * prior.J;
    b.head(24) = prior.J.transpose() * prior.r;
    for (std::size_t l = 0; l < points.size(); ++l) {
      for (std::size_t k = 0; k < 6; ++k) {
        Eigen::Matrix<double, 2, 7, Eigen::RowMajor> Jp;
        Eigen::Matrix<double, 2, 3, Eigen::RowMajor> Jl;
        Eigen::Matrix<double, 2, 6, Eigen::RowMajor> Jr;
        double* out[3] = {Jp.data(), Jl.data(), Jr.data()};
        const double* x[3] = {poses[k / 2].data(), points[l].data(), rig.data()};
        base::Vec2 r;
        EXPECT_TRUE(factors[l][k]->Evaluate(x, r.data(), out));
        MatrixXd J = MatrixXd::Zero(2, n);
        J.middleCols<6>(6 * static_cast<int>(k / 2)) = Jp.leftCols<6>();
        J.middleCols<6>(18) = Jr;
        J.middleCols<3>(24 + 3 * static_cast<int>(l)) = Jl;
        const double w = std::min(1.0, huber / r.norm());
        H += w * J.transpose() * J;
        b += w * J.transpose() * r;
      }
    }
    return {H, b};
  }
};

/// Schur complement onto columns [from, from + count), everything else eliminated.
std::pair<MatrixXd, VectorXd> Condense(const MatrixXd& H, const VectorXd& b, int from, int count) {
  std::vector<int> keep, drop;
  for (int i = 0; i < H.cols(); ++i) (i >= from && i < from + count ? keep : drop).push_back(i);
  const MatrixXd K = H(keep, drop) * H(drop, drop).inverse();
  return {H(keep, keep) - K * H(drop, keep), VectorXd(b(keep) - K * b(drop))};
}

TEST(NormalEquations, EliminateLandmarksLikeDenseAlgebra) {
  for (const double huge : {0.0, 0.05}) {
    Scene scene(huge);
    const NormalEquations system = scene.Assemble(2.0);
    const auto [H, b] = scene.BruteForce(2.0);
    const auto [H_schur, b_schur] = Condense(H, b, 0, 24);
    EXPECT_LT((system.H() - H_schur).norm() / H_schur.norm(), 1e-7);
    EXPECT_LT((system.b() - b_schur).norm() / b_schur.norm(), 1e-6);
  }
}

TEST(Marginalise, EqualsTheDenseSchurComplement) {
  Scene scene;
  const NormalEquations system = scene.Assemble(2.0);
  const LinearPrior prior = Marginalise(system, 6);
  const auto [H, b] = scene.BruteForce(2.0);
  const auto [S, s] = Condense(H, b, 6, 18);
  ASSERT_EQ(prior.blocks.size(), 3U);
  EXPECT_EQ(prior.blocks[0].x, scene.poses[1].data());
  EXPECT_LT((prior.J.transpose() * prior.J - S).norm() / S.norm(), 1e-7);
  EXPECT_LT((prior.J.transpose() * prior.r - s).norm() / s.norm(), 1e-6);
}

/// The prior has the step, and the cost differences, of the system that it stands for.
TEST(Marginalise, KeepsTheSolutionOfTheOthers) {
  Scene scene;
  const auto [H, b] = scene.BruteForce(2.0);
  const VectorXd full = H.ldlt().solve(-b);
  const LinearPrior prior = Marginalise(scene.Assemble(2.0), 6);
  const VectorXd reduced = prior.J.colPivHouseholderQr().solve(-prior.r);
  EXPECT_LT((full.segment(6, 18) - reduced).norm() / reduced.norm(), 1e-5);
}

TEST(Marginalise, ShiftsTheResidualToTheLinearisationPoint) {
  Scene scene;
  // The second pose has moved since it was linearised.
  std::array<double, 7> first = scene.poses[1];
  const base::Vec6 step = base::Vec6::Constant(1e-3);
  PosePlus(first.data(), step.data(), scene.poses[1].data());
  NormalEquations system;
  system.AddBlock(scene.poses[0].data(), BlockKind::kPose);
  system.AddBlock(scene.poses[1].data(), BlockKind::kPose, first.data());
  system.AddBlock(scene.poses[2].data(), BlockKind::kPose);
  system.AddBlock(scene.rig.data(), BlockKind::kRig);
  system.Allocate();
  for (LinearBlock& block : scene.prior.blocks) {
    if (block.x == scene.poses[1].data()) std::copy(first.begin(), first.end(), block.x0.begin());
  }
  system.Add(scene.prior);
  const LinearPrior prior = Marginalise(system, 6);
  // Nothing couples the blocks here: what is left of the prior gives the same residual at the same values.
  EXPECT_LT((prior.J.transpose() * prior.Residual() - system.b().tail(18)).norm(), 1e-9);
  EXPECT_NEAR(prior.blocks[0].x0[0], first[0], 0.0);
}

TEST(MarginalCovariance, IsTheBlockOfTheInverse) {
  Scene scene;
  const NormalEquations system = scene.Assemble(2.0);
  const MatrixXd inverse = system.H().inverse();
  EXPECT_LT((MarginalCovariance(system.H(), 6, 6) - inverse.block(6, 6, 6, 6)).norm() / inverse.norm(), 1e-9);
}

}  // namespace
}  // namespace alula::stack::estimation::test
