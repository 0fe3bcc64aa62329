#include "base/frames.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace alula::base {
namespace {

constexpr double kEpsilon = 2.220446049250313e-16;

Vec3 RandomRotationVector(RandomStream& random, double largest) {
  const Vec3 axis = random.GaussianVec3().normalized();
  return axis * random.Uniform(0, largest);
}

TEST(Rotation, ExpIsTheMatrixExponential) {
  RandomStream random(1, "exp");
  for (int i = 0; i < 100; ++i) {
    const Vec3 phi = RandomRotationVector(random, 3.0);
    Mat3 sum = Mat3::Identity(), term = Mat3::Identity();
    for (int k = 1; k < 60; ++k) {
      term = term * Hat(phi) / k;
      sum += term;
    }
    EXPECT_LT((Exp(phi).toRotationMatrix() - sum).norm(), 1e-13);  // 60 terms lose about e³ epsilons
  }
}

TEST(Rotation, LogUndoesExp) {
  RandomStream random(2, "log");
  for (const double largest : {1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0, 3.14}) {
    for (int i = 0; i < 50; ++i) {
      const Vec3 phi = RandomRotationVector(random, largest);
      EXPECT_LT((Log(Exp(phi)) - phi).norm(), 20 * kEpsilon * std::max(1.0, largest)) << largest;
      const Quat opposite(-Exp(phi).coeffs());  // the same rotation
      EXPECT_LT((Log(opposite) - phi).norm(), 20 * kEpsilon * std::max(1.0, largest));
    }
  }
  EXPECT_EQ(Log(Quat::Identity()), Vec3(0, 0, 0));
}

TEST(Rotation, RightJacobianAgreesWithPerturbation) {
  RandomStream random(3, "jacobian");
  constexpr double kStep = 1e-6;
  for (const double largest : {1e-5, 1e-3, 1.0, 3.0}) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 phi = RandomRotationVector(random, largest);
      Mat3 numeric;
      for (int k = 0; k < 3; ++k) {
        const Vec3 delta = kStep * Vec3::Unit(k);
        numeric.col(k) =
            (Log(Exp(phi).conjugate() * Exp(phi + delta)) - Log(Exp(phi).conjugate() * Exp(phi - delta))) / (2 * kStep);
      }
      // Central differences: step² of truncation and epsilon/step of rounding, both near 1e-10.
      EXPECT_LT((RightJacobian(phi) - numeric).norm(), 2e-9);
      EXPECT_LT((RightJacobian(phi) * RightJacobianInverse(phi) - Mat3::Identity()).norm(), 1e-9);
    }
  }
}

TEST(Transform, ComposesAndInverts) {
  RandomStream random(4, "transform");
  for (int i = 0; i < 50; ++i) {
    const Transform X_WB{Exp(random.GaussianVec3()), random.GaussianVec3()};
    const Transform X_BC{Exp(random.GaussianVec3()), random.GaussianVec3()};
    const Vec3 p_C = random.GaussianVec3();
    EXPECT_LT(((X_WB * X_BC) * p_C - X_WB * (X_BC * p_C)).norm(), 20 * kEpsilon * 10);
    const Transform one = X_WB * X_WB.Inverse();
    EXPECT_LT(one.p.norm() + Log(one.q).norm(), 20 * kEpsilon * 10);
  }
}

TEST(Frames, AxesAreWhereTheConventionsSay) {
  EXPECT_NEAR(Yaw(FromYaw(0.7)), 0.7, 4 * kEpsilon);
  EXPECT_NEAR(Yaw(FromYawPitchRoll(-2.0, 0.4, 0.3)), -2.0, 4 * kEpsilon);
  // Positive pitch about y-left lowers the nose; positive roll about x-forward lowers the right side.
  EXPECT_LT((FromYawPitchRoll(0, 0.1, 0) * Vec3::UnitX()).z(), 0);
  EXPECT_GT((FromYawPitchRoll(0, 0, 0.1) * Vec3::UnitY()).z(), 0);
  const Quat q_BC = ForwardCameraRotation();
  EXPECT_LT((q_BC * Vec3::UnitZ() - Vec3::UnitX()).norm(), 4 * kEpsilon);   // forward
  EXPECT_LT((q_BC * Vec3::UnitX() - Vec3(0, -1, 0)).norm(), 4 * kEpsilon);  // right
  EXPECT_LT((q_BC * Vec3::UnitY() - Vec3(0, 0, -1)).norm(), 4 * kEpsilon);  // down
  EXPECT_DOUBLE_EQ(WrapAngle(3 * M_PI), M_PI);
  EXPECT_DOUBLE_EQ(WrapAngle(-M_PI), M_PI);
  EXPECT_NEAR(WrapAngle(-7.0), -7.0 + 2 * M_PI, 10 * kEpsilon);
}

}  // namespace
}  // namespace alula::base
