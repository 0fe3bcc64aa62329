#include <gtest/gtest.h>

#include "base/random.h"
#include "stack/estimation/internal/imu_factor.h"
#include "stack/estimation/internal/prior_factor.h"
#include "stack/estimation/internal/reprojection_factor.h"
#include "tests/gradients/perturbation.h"

namespace alula::stack::estimation::test {
namespace {

using base::Exp;
using base::Time;
using base::Transform;
using base::Vec3;

Eigen::VectorXd Draw(base::RandomStream& random, int n, double sigma) {
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) x[i] = sigma * random.Gaussian();
  return x;
}

TEST(Gradients, ReprojectionInBothEyes) {
  base::RandomStream random(1, "gradients/reprojection");
  for (int trial = 0; trial < 20; ++trial) {
    PairModel pair;
    pair.X_IC = {Exp(0.3 * random.GaussianVec3()), 0.1 * random.GaussianVec3()};
    pair.X_RL = {Exp(0.02 * random.GaussianVec3()), Vec3(-0.11, 0.001, 0.002)};
    pair.v_OI = 2.0 * random.GaussianVec3();
    pair.w_I = random.GaussianVec3();
    pair.weight = 381.0;
    const Transform X_OI{Exp(random.GaussianVec3()), random.GaussianVec3()};
    const Vec3 p_O = X_OI * pair.X_IC * Vec3(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(3, 10));
    const Eigen::VectorXd rig = Draw(random, 6, 0.01);
    for (const bool right : {false, true}) {
      const ReprojectionFactor factor(pair, right, {0.1, -0.2});
      ExpectJacobians(factor, {PoseBlock(X_OI), LandmarkBlock(p_O), VectorBlock(BlockKind::kRig, rig)});
    }
  }
}

TEST(Gradients, ImuFactor) {
  base::RandomStream random(2, "gradients/imu");
  for (int trial = 0; trial < 10; ++trial) {
    ImuNoise noise{1e-1, 1e-1, 1e-1, 1e-1, 0, 0, 0, 0};  // large, so that whitening does not hide a row
    ImuPreintegration integral(noise, 0.01 * random.GaussianVec3(), 0.1 * random.GaussianVec3());
    std::vector<TimedImu> samples;
    for (int i = 0; i <= 40; ++i) {
      samples.push_back({Time{i * 5'000'000}, random.GaussianVec3(), Vec3(0, 0, 9.8) + random.GaussianVec3()});
    }
    integral.Append(samples);
    const ImuFactor factor(integral);
    const Transform X_i{Exp(random.GaussianVec3()), random.GaussianVec3()};
    const Transform X_j{X_i.q * integral.dR() * Exp(0.2 * random.GaussianVec3()), random.GaussianVec3()};
    Eigen::VectorXd s_i = Draw(random, 9, 0.5), s_j = Draw(random, 9, 0.5);
    s_i.segment<3>(3) = integral.gyro_bias() + 0.02 * random.GaussianVec3();
    ExpectJacobians(factor, {PoseBlock(X_i), VectorBlock(BlockKind::kSpeedBias, s_i), PoseBlock(X_j),
                             VectorBlock(BlockKind::kSpeedBias, s_j)});
  }
}

TEST(Gradients, Prior) {
  base::RandomStream random(3, "gradients/prior");
  TestBlock pose = PoseBlock({Exp(random.GaussianVec3()), random.GaussianVec3()});
  TestBlock speed = VectorBlock(BlockKind::kSpeedBias, Draw(random, 9, 1.0));
  TestBlock rig = VectorBlock(BlockKind::kRig, Draw(random, 6, 1.0));
  LinearPrior prior;
  for (TestBlock* b : {&pose, &speed, &rig}) {
    LinearBlock linear{b->x.data(), b->kind, {}};
    std::copy(b->x.begin(), b->x.end(), linear.x0.begin());
    prior.blocks.push_back(linear);
  }
  prior.J = Eigen::MatrixXd(21, 21);
  for (int i = 0; i < 21; ++i) prior.J.row(i) = Draw(random, 21, 1.0).transpose();
  prior.r = Draw(random, 21, 1.0);
  const PriorFactor factor(prior);
  for (int axis = 0; axis < 6; ++axis) pose.x = Moved(pose, axis, 0.1 * random.Gaussian());
  ExpectJacobians(factor, {pose, speed, rig});
}

}  // namespace
}  // namespace alula::stack::estimation::test
