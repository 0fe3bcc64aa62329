#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "base/random.h"
#include "stack/estimation/internal/line_factor.h"

namespace alula::stack::estimation::test {
namespace {

using base::Vec2;
using base::Vec3;

struct Scene {
  std::array<double, kPoseSize> pose{};
  std::array<double, kRigSize> rig{};
  std::array<double, kLineSize> line{};
  Vec3 a, b;
  PairModel pair;

  explicit Scene(std::uint64_t seed) {
    base::RandomStream random(seed, "test/line");
    const base::Transform X_OI{base::Exp(0.3 * random.GaussianVec3()), random.GaussianVec3()};
    SetPose(X_OI, pose.data());
    for (double& x : rig) x = 0.01 * random.Gaussian();
    pair.X_IC = {base::ForwardCameraRotation() * base::Exp(0.05 * random.GaussianVec3()), Vec3(0.1, 0.02, -0.01)};
    pair.X_RL = {base::Exp(0.02 * random.GaussianVec3()), Vec3(-0.11, 0.002, 0.001)};
    pair.v_OI = random.GaussianVec3();
    pair.w_I = 0.5 * random.GaussianVec3();
    pair.weight = 400.0;
    a = X_OI * (pair.X_IC * Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(2, 6)));
    b = X_OI * (pair.X_IC * Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(2, 6)));
    SetLine(LineThrough(a, b), line.data());
  }

  /// Where an eye sees a point.
  Vec2 See(const Vec3& p_O, bool right) const {
    const ReprojectionFactor factor(pair, right, Vec2::Zero());
    Vec2 r;
    const double* at[3] = {pose.data(), p_O.data(), rig.data()};
    EXPECT_TRUE(factor.Evaluate(at, r.data(), nullptr));
    return r / pair.weight;
  }
};

TEST(LineGeometry, ParametersKeepTheLine) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    const PluckerLine line = LineAt(scene.line.data());
    for (const Vec3& p : {scene.a, scene.b}) EXPECT_LT((NearestOn(line, p) - p).norm(), 1e-9);
    EXPECT_GT(line.v.dot(scene.b - scene.a), 0.0);
    const auto seen = SeenAlong(line, Vec3(1, 2, 3), scene.b - Vec3(1, 2, 3));
    ASSERT_TRUE(seen);
    EXPECT_LT((*seen - scene.b).norm(), 1e-9);
  }
}

TEST(LineFactor, IsZeroForWhatTheEyesSee) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    for (const bool right : {false, true}) {
      const LineFactor factor(scene.pair, right, {scene.See(scene.a, right), scene.See(scene.b, right)}, 1.0 / 400);
      Vec2 r;
      const double* at[3] = {scene.pose.data(), scene.line.data(), scene.rig.data()};
      ASSERT_TRUE(factor.Evaluate(at, r.data(), nullptr));
      EXPECT_LT(r.norm(), 1e-8);
      // The other way round it is not the same edge: half a turn.
      const LineFactor reverse(scene.pair, right, {scene.See(scene.b, right), scene.See(scene.a, right)}, 1.0 / 400);
      ASSERT_TRUE(reverse.Evaluate(at, r.data(), nullptr));
      const double length = (scene.See(scene.a, right) - scene.See(scene.b, right)).norm();
      EXPECT_NEAR(std::abs(r[1]), M_PI * length * 400 / std::sqrt(2.0), 1e-6);
    }
  }
}

TEST(LineFactor, JacobiansByPerturbation) {
  base::RandomStream random(9, "test/line");
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Scene scene(seed);
    for (const bool right : {false, true}) {
      const auto near = [&] { return Vec2(0.01 * random.Gaussian(), 0.01 * random.Gaussian()); };
      const LineFactor factor(scene.pair, right,
                              {scene.See(scene.a, right) + near(), scene.See(scene.b, right) + near()}, 1.0 / 400);
      Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_pose;
      Eigen::Matrix<double, 2, 5, Eigen::RowMajor> by_line;
      Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_rig;
      double* out[3] = {by_pose.data(), by_line.data(), by_rig.data()};
      const double* at[3] = {scene.pose.data(), scene.line.data(), scene.rig.data()};
      Vec2 r;
      ASSERT_TRUE(factor.Evaluate(at, r.data(), out));
      constexpr double h = 1e-6;
      const auto numeric = [&](int block, int column) {
        Vec2 side[2];
        for (int s = 0; s < 2; ++s) {
          std::array<double, 7> d{};
          d[static_cast<std::size_t>(column)] = s == 0 ? h : -h;
          Scene moved = scene;
          if (block == 0) PosePlus(scene.pose.data(), d.data(), moved.pose.data());
          if (block == 1) LinePlus(scene.line.data(), d.data(), moved.line.data());
          if (block == 2) moved.rig[static_cast<std::size_t>(column)] += d[static_cast<std::size_t>(column)];
          const double* there[3] = {moved.pose.data(), moved.line.data(), moved.rig.data()};
          EXPECT_TRUE(factor.Evaluate(there, side[s].data(), nullptr));
        }
        return Vec2((side[0] - side[1]) / (2 * h));
      };
      const auto check = [&](const Vec2& analytic, int block, int column) {
        const Vec2 n = numeric(block, column);
        EXPECT_LT((analytic - n).norm(), 1e-6 * std::max(1.0, n.norm())) << seed << " " << block << " " << column;
      };
      for (int c = 0; c < 6; ++c) check(by_pose.col(c), 0, c);
      for (int c = 0; c < 4; ++c) check(by_line.col(c), 1, c);
      for (int c = 0; c < 6; ++c) check(by_rig.col(c), 2, c);
    }
  }
}

TEST(LineSpread, IsWhatMonteCarloGives) {
  const Scene scene(3);
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  base::RandomStream random(4, "test/line");
  Eigen::Matrix4d root = Eigen::Matrix4d::Identity() * 200.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) root(i, j) = 50.0 * random.Gaussian();
  }
  information = root * root.transpose();
  const Vec3 middle = 0.5 * (scene.a + scene.b);
  const auto spread = SpreadOf(scene.line.data(), information, middle);
  ASSERT_TRUE(spread);
  base::Mat3 turns = base::Mat3::Zero(), moves = base::Mat3::Zero();
  const PluckerLine line = LineAt(scene.line.data());
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Vector4d g;
    for (int k = 0; k < 4; ++k) g[k] = random.Gaussian();
    const Eigen::Vector4d d = root.transpose().inverse() * g;
    std::array<double, kLineSize> moved{};
    LinePlus(scene.line.data(), d.data(), moved.data());
    const PluckerLine other = LineAt(moved.data());
    const Vec3 turn = other.v.normalized() - line.v.normalized();
    const Vec3 v = line.v.normalized(), shift = NearestOn(other, middle) - middle, across = shift - v * v.dot(shift);
    turns += turn * turn.transpose() / kDraws;
    moves += across * across.transpose() / kDraws;
  }
  const auto worst = [](const base::Mat3& C) {
    return std::sqrt(Eigen::SelfAdjointEigenSolver<base::Mat3>(C).eigenvalues()[2]);
  };
  EXPECT_NEAR(spread->direction, worst(turns), 0.05 * worst(turns));
  EXPECT_NEAR(spread->place, worst(moves), 0.05 * worst(moves));
  EXPECT_FALSE(SpreadOf(scene.line.data(), Eigen::Matrix4d::Zero(), middle));
}

}  // namespace
}  // namespace alula::stack::estimation::test
