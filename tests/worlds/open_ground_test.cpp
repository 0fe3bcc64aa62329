#include "worlds/open_ground.h"

#include <gtest/gtest.h>

#include "worlds/world_hash.h"

namespace alula::worlds {
namespace {

OpenGroundConfig Small() {
  OpenGroundConfig config;
  config.texture_size = 32;
  return config;
}

TEST(OpenGround, PadStandsInTheMiddleAndBlocksFarAway) {
  const World world = MakeWorld(Small(), 1);
  EXPECT_EQ(world.pad_object, "pad");
  EXPECT_EQ(world.objects.size(), 2U + 10U);
  EXPECT_TRUE(world.gates.empty());
  for (const Object& object : world.objects) {
    if (object.name.rfind("block", 0) != 0) continue;
    EXPECT_GE(object.X_WO.p.head<2>().norm(), 12.0);
    EXPECT_DOUBLE_EQ(object.X_WO.p.z(), std::get<geometry::Box>(object.shape).half_extents.z());
  }
  const auto& pad = world.objects[1];
  EXPECT_DOUBLE_EQ(world.X_WB_start.p.z(), pad.X_WO.p.z() + std::get<geometry::Cylinder>(pad.shape).half_height);
  EXPECT_NEAR(world.light.to_sun_W.norm(), 1.0, 1e-12);
}

TEST(OpenGround, SameSeedSameWorld) {
  base::RollingHash a;
  base::RollingHash b;
  base::RollingHash c;
  AddTo(a, MakeWorld(Small(), 1));
  AddTo(b, MakeWorld(Small(), 1));
  AddTo(c, MakeWorld(Small(), 2));
  EXPECT_EQ(a.value(), b.value());
  EXPECT_NE(a.value(), c.value());
}

}  // namespace
}  // namespace alula::worlds
