#include "scenarios/report/chase_camera.h"

#include <gtest/gtest.h>

namespace alula::scenarios {
namespace {

TEST(LookAt, PutsTheTargetOnTheOpticalAxisWithTheImageUpright) {
  const base::Vec3 eye(1, 2, 3);
  const base::Vec3 target(4, -1, 2.5);
  const base::Transform X_WC = LookAt(eye, target);
  const base::Vec3 p_C = X_WC.Inverse() * target;
  EXPECT_NEAR(p_C.x(), 0.0, 1e-12);
  EXPECT_NEAR(p_C.y(), 0.0, 1e-12);
  EXPECT_GT(p_C.z(), 0.0);
  EXPECT_LT((X_WC.q * base::Vec3::UnitY()).z(), 0.0);  // image down points to the ground
}

TEST(ChaseCamera, StaysInsideTheWallsAndSettlesBehindTheVehicle) {
  const base::Vec3 low(-5, -5, 0);
  const base::Vec3 high(5, 5, 3);
  ChaseCamera camera(low, high);
  const base::Transform X_WB{base::FromYaw(0.5 * M_PI), base::Vec3(0, -4.8, 1)};
  base::Transform X_WC;
  for (int i = 0; i < 200; ++i) X_WC = camera.Follow(X_WB, base::Milliseconds(33));
  EXPECT_GE(X_WC.p.y(), low.y());
  EXPECT_LT(X_WC.p.y(), X_WB.p.y() + 0.2);
  EXPECT_GT(X_WC.p.z(), X_WB.p.z());
  EXPECT_GT((X_WC.Inverse() * X_WB.p).z(), 0.0);  // in view
}

}  // namespace
}  // namespace alula::scenarios
