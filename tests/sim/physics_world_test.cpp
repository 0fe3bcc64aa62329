#include "sim/physics_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

using base::Vec3;
constexpr base::Duration kStep = base::Milliseconds(1);

TEST(PhysicsWorld, FallsFreelyAsSemiImplicitEulerDoes) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 8}));
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i) physics.Step({}, kStep);
  // v_n = −g n dt;  p_n = p_0 − g dt² n (n + 1) / 2: exact for this integrator.
  EXPECT_NEAR(physics.state().v_WB.z(), -base::kGravity, 1e-11);
  EXPECT_NEAR(physics.state().X_WB.p.z(), 8.0 - base::kGravity * 1e-6 * n * (n + 1) / 2.0, 1e-11);
  EXPECT_LT(physics.state().w_B.norm(), 1e-15);
}

TEST(PhysicsWorld, HoversUnderItsWeight) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 2}));
  for (int i = 0; i < 1000; ++i) physics.Step({.force_W = {0, 0, base::kGravity}}, kStep);
  EXPECT_LT((physics.state().X_WB.p - Vec3(0, 0, 2)).norm(), 1e-12);
}

TEST(PhysicsWorld, KeepsAngularMomentumToRounding) {
  vehicles::VehicleBody body = testing::PlateOnLegs();
  const base::Quat q = base::Exp({0.3, -0.5, 0.2});  // principal axes turned against the body's
  body.inertia =
      q.toRotationMatrix() * base::Mat3(Vec3(2e-3, 5e-3, 6.5e-3).asDiagonal()) * q.toRotationMatrix().transpose();
  vehicles::BodyState start = testing::At({0, 0, 9});
  start.w_B = {8.0, -5.0, 3.0};
  PhysicsWorld physics(testing::GroundAndCrate(), body, start);
  const auto momentum = [&] { return Vec3(physics.state().X_WB.q * Vec3(body.inertia * physics.state().w_B)); };
  const auto energy = [&] { return 0.5 * physics.state().w_B.dot(body.inertia * physics.state().w_B); };
  const Vec3 L = momentum();
  const double E = energy();
  for (int i = 0; i < 5000; ++i) physics.Step({.force_W = {0, 0, base::kGravity}}, kStep);
  EXPECT_LT((momentum() - L).norm(), 1e-12);
  // Energy to second order: (ω dt)² = 1e-4 a radian turned would be the size of a first-order scheme's error.
  EXPECT_NEAR(energy() / E, 1.0, 1e-4);
}

TEST(PhysicsWorld, SpinsUpUnderConstantTorqueAboutAPrincipalAxis) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 5}));
  for (int i = 0; i < 500; ++i) physics.Step({.force_W = {0, 0, base::kGravity}, .torque_W = {0, 0, 0.016}}, kStep);
  EXPECT_NEAR(physics.state().w_B.z(), 0.016 / 8e-3 * 0.5, 1e-12);
}

TEST(PhysicsWorld, StandsStillOnItsLegsAndNamesWhatTouches) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 0.1}));
  for (int i = 0; i < 1000; ++i) physics.Step({}, kStep);
  Vec3 fastest = Vec3::Zero(), spin = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) {
    physics.Step({}, kStep);
    fastest = fastest.cwiseMax(physics.state().v_WB.cwiseAbs());
    spin = spin.cwiseMax(physics.state().w_B.cwiseAbs());
  }
  EXPECT_LT(fastest.maxCoeff(), 1e-4);
  EXPECT_LT(spin.maxCoeff(), 1e-3);
  EXPECT_NEAR(physics.state().X_WB.p.z(), 0.1, 5e-4);
  std::vector<std::string> parts;
  for (const Contact& contact : physics.contacts()) {
    EXPECT_EQ(contact.object, "ground");
    EXPECT_TRUE(contact.may_touch);
    parts.emplace_back(contact.part);
  }
  for (const char* leg : {"leg0", "leg1", "leg2", "leg3"})
    EXPECT_TRUE(std::count(parts.begin(), parts.end(), leg)) << leg;
}

TEST(PhysicsWorld, NamesPartAndObjectOfACrash) {
  vehicles::BodyState start = testing::At({2.5, 0, 0.5});
  start.v_WB = {5, 0, 0};
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), start);
  for (int i = 0; i < 200 && physics.contacts().empty(); ++i) physics.Step({.force_W = {0, 0, base::kGravity}}, kStep);
  ASSERT_FALSE(physics.contacts().empty());
  EXPECT_EQ(physics.contacts()[0].part, "plate");
  EXPECT_EQ(physics.contacts()[0].object, "crate");
  EXPECT_FALSE(physics.contacts()[0].may_touch);
  EXPECT_NEAR(physics.contacts()[0].point_W.x(), 3.0, 0.01);
}

TEST(PhysicsWorld, MeasuresHullClearanceAsBoxesHaveIt) {
  base::RandomStream random(1, "test/clearance");
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 1}));
  EXPECT_NEAR(physics.HullClearance(10).distance, 0.98, 1e-6);  // plate's underside above the ground; legs do not count
  EXPECT_EQ(physics.HullClearance(10).object, "ground");
  const std::string_view ground[] = {"ground"};
  EXPECT_NEAR(physics.HullClearance(10, ground).distance, std::hypot(2.9, 0.0), 1e-6);
  EXPECT_EQ(physics.HullClearance(0.5).distance, 0.5);  // not looked for beyond the reach

  // A sphere-like check by brute force: corners of the plate against the crate, any attitude, in front of its face.
  vehicles::VehicleBody body = testing::PlateOnLegs();
  body.prescribed = true;
  PhysicsWorld moved(testing::GroundAndCrate(), body, testing::At({0, 0, 1}));
  for (int i = 0; i < 50; ++i) {
    const base::Transform X{base::Exp(random.GaussianVec3()), {random.Uniform(1.5, 2.7), 0, 0.5}};
    double expected = 1e9;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = X * Vec3((corner & 1) ? 0.1 : -0.1, (corner & 2) ? 0.1 : -0.1, (corner & 4) ? 0.02 : -0.02);
      expected = std::min(expected, 3.0 - p.x());
    }
    moved.MovePrescribed({X, Vec3::Zero(), Vec3::Zero()});
    // Bullet rounds corners with a radius of 0.2 mm: they lie up to (√3 − 1)·0.2 mm inside.
    EXPECT_NEAR(moved.HullClearance(10, ground).distance, expected, 1.6e-4);
  }
}

TEST(PhysicsWorld, CastsRaysThroughTheVehicle) {
  PhysicsWorld physics(testing::GroundAndCrate(), testing::PlateOnLegs(), testing::At({0, 0, 0.5}));
  const auto hit = physics.CastRay({-1, 0, 0.5}, {9, 0, 0.5});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->object, "crate");
  EXPECT_NEAR(hit->distance, 4.0, 1e-3);
  EXPECT_FALSE(physics.CastRay({0, 0, 5}, {9, 0, 5}));
}

TEST(PhysicsWorld, PrescribedVehicleIsWhereItIsPutAndTouches) {
  vehicles::VehicleBody body = testing::PlateOnLegs();
  body.prescribed = true;
  PhysicsWorld physics(testing::GroundAndCrate(), body, testing::At({0, 0, 1}));
  EXPECT_TRUE(physics.contacts().empty());
  physics.MovePrescribed(testing::At({2.95, 0, 0.5}));
  ASSERT_FALSE(physics.contacts().empty());
  EXPECT_EQ(physics.contacts()[0].object, "crate");
  physics.MovePrescribed(testing::At({1, 0, 1.5}));
  EXPECT_TRUE(physics.contacts().empty());
  EXPECT_EQ(physics.state().X_WB.p, Vec3(1, 0, 1.5));
}

}  // namespace
}  // namespace alula::sim
