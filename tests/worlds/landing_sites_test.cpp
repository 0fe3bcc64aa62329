#include "worlds/landing_sites.h"

#include <gtest/gtest.h>

#include <cmath>

namespace alula::worlds {
namespace {

/// A plate of 10 m × 10 m, tilted about x, inside bounds of 8 m × 8 m.
World Plate(double tilt) {
  World world;
  world.materials.resize(1);
  world.objects.push_back(
      {"ground", geometry::Box{{6, 6, 0.5}}, {base::FromYawPitchRoll(0, 0, tilt), {0, 0, -0.5 / std::cos(tilt)}}, 0});
  world.bounds_low = {-4, -4, -3};
  world.bounds_high = {4, 4, 5};
  return world;
}

TEST(LandingSites, AllOfAFlatPlateButItsRim) {
  const LandingSites sites = FindLandingSites(Plate(0.0));
  EXPECT_EQ(sites.columns, 80);
  // 0.7 m at each side is lost to radius and margin; the footprint's cells beyond the grid lie within that.
  const double expected = std::pow((8.0 - 2.0 * 0.9) / 8.0, 2);  // 0.2 m of cells without a footprint, then 0.7 m
  EXPECT_NEAR(sites.SafeShare(), expected, 0.03);                // of a cell a side: 0.1 / 8 · 2
}

TEST(LandingSites, SlopeHasALimit) {
  constexpr double kDegree = 3.14159265358979 / 180.0;
  EXPECT_GT(FindLandingSites(Plate(9.0 * kDegree)).SafeShare(), 0.5);
  EXPECT_EQ(FindLandingSites(Plate(11.0 * kDegree)).SafeShare(), 0.0);
}

/// The radius about the middle that a thing there makes unsafe: its own reach, the footprint's, and the erosion's.
void ExpectHole(const World& world, double reach) {
  const LandingSites sites = FindLandingSites(world);
  for (int j = 0; j < sites.rows; ++j) {
    for (int i = 0; i < sites.columns; ++i) {
      const double away = sites.Middle(i, j).norm();
      if (away < reach + 0.7) {
        EXPECT_EQ(sites.safe[sites.Index(i, j)], 0) << away;
      } else if (away > reach + 0.2 + 0.7 + 0.3 && sites.Middle(i, j).cwiseAbs().maxCoeff() < 3.0) {
        EXPECT_EQ(sites.safe[sites.Index(i, j)], 1) << away;  // 0.3: cells of three discs
      }
    }
  }
}

TEST(LandingSites, StepsStonesWiresAndFoliageAreKeptClearOf) {
  World step = Plate(0.0);
  step.objects.push_back({"kerb", geometry::Box{{0.5, 0.5, 0.05}}, {base::Quat::Identity(), {0, 0, 0}}, 0});
  ExpectHole(step, 0.4);
  World pin = Plate(0.0);  // thinner than a cell, between the cells' middles
  pin.objects.push_back({"pin", geometry::Cylinder{0.005, 0.5}, {base::Quat::Identity(), {0.0, 0.0, 0.5}}, 0});
  ExpectHole(pin, 0.0);
  World leaf = Plate(0.0);  // seen, not hit
  leaf.objects.push_back(
      {"leaf", geometry::Box{{0.3, 0.3, 0.002}}, {base::Quat::Identity(), {0, 0, 0.01}}, 0, 1.0, false});
  ExpectHole(leaf, 0.2);
}

TEST(LandingSites, WhatHangsAboveTheBoundsDoesNotCount) {
  World world = Plate(0.0);
  const double open = FindLandingSites(world).SafeShare();
  world.objects.push_back({"roof", geometry::Box{{4, 4, 0.1}}, {base::Quat::Identity(), {0, 0, 6.0}}, 0});
  EXPECT_EQ(FindLandingSites(world).SafeShare(), open);
  world.objects.back().X_WO.p.z() = 3.0;  // now it is what one would land on
  EXPECT_NEAR(FindLandingSites(world).top[0], 3.1, 1e-6);
}

}  // namespace
}  // namespace alula::worlds
