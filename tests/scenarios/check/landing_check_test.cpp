#include "scenarios/check/landing_check.h"

#include <gtest/gtest.h>

#include "vehicles/quadrotor.h"

namespace alula::scenarios::check {
namespace {

vehicles::VehicleBody Q250() { return vehicles::LayOutQuadrotor({}).body; }

worlds::World Plate(double tilt) {
  worlds::World world;
  world.materials.resize(1);
  world.objects.push_back(
      {"ground", geometry::Box{{6, 6, 0.5}}, {base::FromYawPitchRoll(0, 0, tilt), {0, 0, -0.5 / std::cos(tilt)}}, 0});
  world.bounds_low = {-4, -4, -4};
  world.bounds_high = {4, 4, 5};
  return world;
}

Drop DropOn(const worlds::World& world, const base::Vec2& p) {
  return DropAt(world, ExtentsOf(world), Q250(), worlds::FindLandingSites(world), {p, 0.4, 0.03});
}

TEST(LandingCheck, StandsOnLevelGroundAndOnAGentleSlope) {
  for (const double tilt : {0.0, 0.16}) {
    const Drop drop = DropOn(Plate(tilt), {0.33, -0.41});
    EXPECT_TRUE(drop.stood) << drop.tilt << ' ' << drop.slide << ' ' << drop.speed << ' ' << drop.touched;
    EXPECT_NEAR(drop.tilt, tilt, 0.01);  // legs sink in by Bullet's slop of 0.1 mm over 0.18 m, and bounce
  }
}

TEST(LandingCheck, SlidesOrFallsWhereItMay) {
  EXPECT_FALSE(DropOn(Plate(0.7), {0.0, 0.0}).stood);  // 40°: friction 0.64 holds up to 33°
  worlds::World post = Plate(0.0);                     // legs astride a post that is higher than they are long
  post.objects.push_back({"post", geometry::Cylinder{0.02, 0.5}, {base::Quat::Identity(), {0, 0, 0.5}}, 0});
  const Drop drop = DropOn(post, {0.0, 0.0});
  EXPECT_FALSE(drop.stood);
  EXPECT_NE(drop.touched.find("on post"), std::string::npos);
}

TEST(LandingCheck, SafeCellsOfARoughWorldStand) {
  worlds::World world = Plate(0.05);
  for (int i = 0; i < 8; ++i) {
    world.objects.push_back({"stone" + std::to_string(i),
                             geometry::Sphere{0.12},
                             {base::Quat::Identity(), {-3.0 + 0.8 * i, 0.9 * (i % 3 - 1), 0.0}},
                             0});
  }
  const LandingReport report = CheckLandingSites(world, Q250(), 40, 1);
  EXPECT_EQ(report.Count(true), 40);
  EXPECT_EQ(report.Count(false), 20);
  EXPECT_EQ(report.StoodShare(true), 1.0);
  EXPECT_TRUE(Passed(report));
}

TEST(LandingCheck, AWorldThatIsSafeNowhereIsNoLandingWorld) {
  const LandingReport report = CheckLandingSites(Plate(0.5), Q250(), 5, 1);
  EXPECT_EQ(report.sites.SafeShare(), 0.0);
  EXPECT_FALSE(Passed(report));
}

TEST(LandingCheck, MapsAreRosMaps) {
  worlds::LandingSites sites;
  sites.low = {-1.0, 2.0};
  sites.cell = 0.5;
  sites.columns = 3;
  sites.rows = 2;
  sites.safe = {1, 0, 0, 0, 0, 1};
  EXPECT_EQ(ToPgm(sites), std::string("P5\n3 2\n255\n") + std::string("\0\0\xfe\xfe\0\0", 6));
  EXPECT_NE(ToMapYaml(sites).find("resolution: 0.5\norigin: [-1, 2, 0.0]"), std::string::npos);
}

}  // namespace
}  // namespace alula::scenarios::check
