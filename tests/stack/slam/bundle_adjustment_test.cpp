#include "stack/slam/bundle_adjustment.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "stack/slam/internal/bundle_residuals.h"
#include "stack/slam/internal/reduced_system.h"

namespace alula::stack::slam {
namespace {

using base::Mat3;
using base::Mat6;
using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;

Eyes StereoEyes() {
  Eyes eyes;
  eyes.X_BL = {base::ForwardCameraRotation() * base::Exp({0.02, -0.01, 0.03}), Vec3(0.1, 0.05, -0.02)};
  eyes.X_LR = Transform{base::Exp({0.004, -0.006, 0.002}), Vec3(0.11, 0.001, -0.002)};
  return eyes;
}

Transform Moved(const Transform& X, const Vec6& d) { return {X.q * base::Exp(d.tail<3>()), X.p + d.head<3>()}; }

/// Six keyframes along a bow that look at a wall of 80 points, seen without noise.
Bundle Scene() {
  base::RandomStream random(1, "test/bundle");
  Bundle bundle;
  bundle.eyes = StereoEyes();
  for (int i = 0; i < 6; ++i) {
    const double s = 0.3 * i;
    bundle.poses.push_back(
        {{base::FromYawPitchRoll(0.1 * s, 0.05 * s, -0.04 * i), Vec3(0.1 * s, s, 0.1 * s * s)}, i == 0});
    bundle.verticals.push_back({i, bundle.poses.back().X_MB.q.conjugate() * Vec3::UnitZ(), 0.004});
  }
  for (int k = 0; k < 80; ++k) {
    BundlePoint point;
    point.p_M = Vec3(random.Uniform(3, 6), random.Uniform(-2, 3), random.Uniform(-1.5, 1.5));
    for (int i = 0; i < 6; ++i) {
      Sight sight{i, Vec2::Zero(), Vec2::Zero(), 1.0 / 458};
      const Vec3 p_L =
          bundle.eyes.X_BL.Inverse() * (bundle.poses[static_cast<std::size_t>(i)].X_MB.Inverse() * point.p_M);
      const Vec3 p_R = bundle.eyes.X_LR->Inverse() * p_L;
      sight.left = p_L.head<2>() / p_L.z();
      sight.right = Vec2(p_R.head<2>() / p_R.z());
      if (k % 5 == 0) sight.right.reset();
      point.sights.push_back(sight);
    }
    bundle.points.push_back(point);
  }
  for (int i = 1; i < 6; ++i) {
    RelativeMotion motion;
    motion.from = i - 1;
    motion.to = i;
    motion.X_FT =
        bundle.poses[static_cast<std::size_t>(i - 1)].X_MB.Inverse() * bundle.poses[static_cast<std::size_t>(i)].X_MB;
    motion.sigma << Vec3::Constant(0.01), Vec3::Constant(0.002);
    bundle.motions.push_back(motion);
  }
  return bundle;
}

void Disturb(Bundle& bundle, double metres, double radians) {
  base::RandomStream random(2, "test/disturb");
  for (BundlePose& pose : bundle.poses) {
    if (pose.fixed) continue;
    Vec6 d;
    d << metres * random.GaussianVec3(), radians * random.GaussianVec3();
    pose.X_MB = Moved(pose.X_MB, d);
  }
  for (BundlePoint& point : bundle.points) {
    if (!point.fixed) point.p_M += metres * random.GaussianVec3();
  }
}

double Farthest(const Bundle& a, const Bundle& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const Transform d = a.poses[i].X_MB.Inverse() * b.poses[i].X_MB;
    farthest = std::max({farthest, d.p.norm(), base::Log(d.q).norm()});
  }
  for (std::size_t k = 0; k < a.points.size(); ++k)
    farthest = std::max(farthest, (a.points[k].p_M - b.points[k].p_M).norm());
  return farthest;
}

TEST(Bundle, FindsTheSceneThatItWasMadeOf) {
  const Bundle truth = Scene();
  Bundle bundle = truth;
  Disturb(bundle, 0.05, 0.02);
  const BundleSummary summary = Adjust(bundle, {30, 2.0, 1e-16});
  EXPECT_GT(summary.initial_cost, 100.0);
  EXPECT_LT(summary.cost, 1e-12);
  EXPECT_LT(Farthest(bundle, truth), 1e-7);
}

TEST(Bundle, FixedPointsHoldPoses) {
  Bundle truth = Scene();
  for (BundlePoint& point : truth.points) point.fixed = true;
  for (BundlePose& pose : truth.poses) pose.fixed = false;
  truth.motions.clear();
  Bundle bundle = truth;
  Disturb(bundle, 0.1, 0.05);
  Adjust(bundle, {30, 2.0, 1e-16});
  EXPECT_LT(Farthest(bundle, truth), 1e-7);
}

TEST(Bundle, AnOutlierPullsNoFartherThanHubersKernelLetsIt) {
  const Bundle truth = Scene();
  Bundle bundle = truth;
  for (std::size_t k = 0; k < 8; ++k) bundle.points[k].sights[2].left += Vec2(0.1, -0.05);  // 51 px off
  Adjust(bundle, {30, 2.0, 1e-12});
  EXPECT_LT((bundle.poses[2].X_MB.p - truth.poses[2].X_MB.p).norm(), 0.01);
}

TEST(Bundle, TheSameBitsTwice) {
  Bundle a = Scene();
  Disturb(a, 0.05, 0.02);
  Bundle b = a;
  Adjust(a, {});
  Adjust(b, {});
  EXPECT_EQ(Farthest(a, b), 0.0);
}

/// Central differences of a function of a tangent vector, beside what is claimed.
template <typename Function, typename Matrix>
void ExpectJacobian(const Function& f, const Matrix& J) {
  constexpr double kStep = 1e-6;
  for (int c = 0; c < J.cols(); ++c) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(J.cols());
    d[c] = kStep;
    const Eigen::VectorXd up = f(d), down = f(-d);
    const Eigen::VectorXd numeric = (up - down) / (2 * kStep);
    EXPECT_LT((numeric - J.col(c)).norm(), 1e-6 * std::max(1.0, J.norm())) << "column " << c;
  }
}

TEST(BundleResiduals, JacobiansOfASightAgreeWithDifferences) {
  const Bundle scene = Scene();
  const Transform& X = scene.poses[3].X_MB;
  for (const std::size_t k : {0U, 1U, 7U}) {
    const Vec3 p = scene.points[k].p_M + Vec3(0.02, -0.03, 0.01);
    const Sight& sight = scene.points[k].sights[3];
    const View view = ViewFrom(X, scene.eyes);
    Vec3 r;
    Mat3 by_L;
    ASSERT_TRUE(SightResidual(view, sight, p, r, &by_L));
    // The epipolar line's direction is held: differences along it turn with the point by less than the tolerance here,
    // because the residual along it is small.
    const auto residual = [&](const Transform& X_MB, const Vec3& p_M) -> Eigen::VectorXd {
      Vec3 out;
      SightResidual(ViewFrom(X_MB, scene.eyes), sight, p_M, out, nullptr);
      return out;
    };
    const double slack = sight.right ? 1e-3 : 1e-6;
    for (int c = 0; c < 3; ++c) {
      const Vec3 d = 1e-6 * Vec3::Unit(c);
      const Vec3 numeric = (residual(X, p + d) - residual(X, p - d)) / 2e-6;
      EXPECT_LT((numeric - (by_L * view.R_LM).col(c)).norm(), slack * by_L.norm());
    }
    const Mat36 by_pose = ByPose(by_L, view, X, p);
    for (int c = 0; c < 6; ++c) {
      const Vec6 d = 1e-6 * Vec6::Unit(c);
      const Vec3 numeric = (residual(Moved(X, d), p) - residual(Moved(X, -d), p)) / 2e-6;
      EXPECT_LT((numeric - by_pose.col(c)).norm(), slack * by_pose.norm());
    }
  }
}

TEST(BundleResiduals, JacobiansOfAMotionAndTheVerticalAgreeWithDifferences) {
  const Bundle scene = Scene();
  const Transform F = scene.poses[1].X_MB, T = Moved(scene.poses[2].X_MB, Vec6::Constant(0.05));
  const RelativeMotion& motion = scene.motions[1];
  Mat6 by_F, by_T;
  MotionJacobians(F, T, motion, by_F, by_T);
  ExpectJacobian([&](const Eigen::VectorXd& d) -> Eigen::VectorXd { return MotionResidual(Moved(F, d), T, motion); },
                 by_F);
  ExpectJacobian([&](const Eigen::VectorXd& d) -> Eigen::VectorXd { return MotionResidual(F, Moved(T, d), motion); },
                 by_T);
  const Vertical vertical{0, Vec3(0.1, -0.05, 0.99).normalized(), 0.004};
  ExpectJacobian(
      [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
        return VerticalResidual({T.q * base::Exp(Vec3(d)), T.p}, vertical);
      },
      VerticalJacobian(T, vertical));
}

/// A band of blocks that is large enough for the sparse way, against Eigen's dense solution.
TEST(ReducedSystem, SparseAndDenseGiveTheSame) {
  for (const int poses : {40, 260}) {
    ReducedSystem system(poses);
    base::RandomStream random(3, "test/reduced");
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * poses, 6 * poses);
    for (int i = 0; i < poses; ++i) {
      for (int j = i; j < std::min(poses, i + 4); ++j) {
        Mat6 block;
        for (int e = 0; e < 36; ++e) block(e / 6, e % 6) = random.Gaussian();
        if (i == j) block = Mat6(block * block.transpose()) + 60.0 * Mat6::Identity();
        system.At(i, j) += block;
        H.block<6, 6>(6 * i, 6 * j) = block;
        H.block<6, 6>(6 * j, 6 * i) = block.transpose();
      }
    }
    for (int i = 0; i < 6 * poses; ++i) system.b()[i] = random.Gaussian();
    Eigen::VectorXd delta;
    ASSERT_TRUE(system.Solve(0.5, delta));
    H.diagonal() *= 1.5;
    EXPECT_LT((H * delta + system.b()).norm(), 1e-9 * system.b().norm());
    system.SetZero();
    EXPECT_FALSE(system.Solve(0.0, delta));  // no information at all
  }
}

}  // namespace
}  // namespace alula::stack::slam
