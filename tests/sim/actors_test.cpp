#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "render/camera_renderer.h"
#include "sim/physics_world.h"
#include "sim/sensors/suite.h"
#include "tests/sim/test_world.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/actors/machines.h"
#include "worlds/actors/person.h"

namespace alula::sim {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;

/// The test world with a person, a car, a drone and a swinging gate in it.
worlds::World Street() {
  worlds::World world = testing::GroundAndCrate();
  worlds::AddPerson(world, "person", {.route = {{-3, -2, 0}, {3, -2, 0}}, .speed = 1.4}, 1);
  worlds::AddCar(world, "car", {.waypoints = {{-8, 4, 0}, {9, 4, 0}}, .speed = 3.0}, 1);
  worlds::AddDrone(world, "drone",
                   {.waypoints = {{-2, 0, 2.5}, {2, 0, 2.5}, {2, 3, 3}, {-2, 3, 3}}, .turn_radius = 1.0}, 0.5, 1);
  worlds::AddSwingingGate(world, 0, "gate0", {{0.0, 2.0}, 0.0, 1.5, 1.4, 0.15}, {});
  return world;
}

vehicles::VehicleBody Prescribed() {
  vehicles::VehicleBody body = testing::PlateOnLegs();
  body.prescribed = true;
  return body;
}

/// Bullet's rays and the depth pass agree on actors at random times and from random places.
TEST(Actors, BulletAndThePictureAgree) {
  const worlds::World world = Street();
  worlds::ActorSimulation actors(world, 4);
  PhysicsWorld physics(world, Prescribed(), testing::At({50, 50, 50}));
  const auto renderer = render::MakeRenderer("raster", world, render::MoversOf(world));
  const stack::CameraIntrinsics k{320, 240, 200, 200, 159.5, 119.5, {}};
  base::RandomStream random(3, "test");
  Time t;
  int compared = 0, different = 0, on_actors = 0;
  render::DepthPicture depth;
  for (int shot = 0; shot < 24; ++shot) {
    t += base::Seconds(random.Uniform(0.05, 0.4));
    actors.Advance(t, {.p_WB = {50, 50, 50}});
    physics.MoveActors(actors, t);
    renderer->PlaceMovers(actors.LinkPoses(t));
    const std::size_t whom = random.Index(world.actors.size());
    const Vec3 at = actors.RootPose(whom, t).p + Vec3(0, 0, 0.3);
    const double around = random.Uniform(-3.1, 3.1);
    const Vec3 eye = at + Vec3(4.0 * std::cos(around), 4.0 * std::sin(around), random.Uniform(0.0, 1.0));
    const base::Transform X_WB{base::FromYaw(around + M_PI), eye};
    const base::Transform X_WC = X_WB * base::Transform{base::ForwardCameraRotation(), Vec3::Zero()};
    renderer->Depth({.X_WC = X_WC, .intrinsics = k}, depth);
    for (int i = 0; i < 300; ++i) {
      const int u = static_cast<int>(random.Index(320)), v = static_cast<int>(random.Index(240));
      const Vec3 ray((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1.0);
      const auto hit = physics.CastRay(X_WC.p, X_WC * Vec3(60.0 * ray));
      const double seen = static_cast<double>(depth.metres[static_cast<std::size_t>(v) * 320 + u]);
      const double expected = hit ? hit->distance / ray.norm() : 0.0;
      if (hit && hit->object != "ground" && hit->object != "crate") ++on_actors;
      ++compared;
      if (std::abs(seen - expected) > 0.03 + 0.01 * expected) ++different;  // edges
    }
  }
  EXPECT_GT(on_actors, 400);
  // Links without collision (spokes, lamps, number plates: within 2 cm of what collides) and edges of thin limbs.
  EXPECT_LT(different, compared / 40);
}

TEST(Actors, ClearanceIsThatOfTheNearestLink) {
  const worlds::World world = Street();
  worlds::ActorSimulation actors(world, 4);
  PhysicsWorld physics(world, Prescribed(), testing::At({0, 0, 5}));
  const Time t = Time{} + Milliseconds(1500);
  actors.Advance(t, {.p_WB = {50, 50, 50}});
  physics.MoveActors(actors, t);
  const Vec3 pelvis = actors.RootPose(0, t).p;
  // The plate (0.1 m half wide) a metre beside the pelvis at its height, away from everything else.
  physics.MovePrescribed(testing::At(pelvis + Vec3(0.0, -1.5, 0.0)));
  physics.MoveActors(actors, t);
  const std::array<std::string_view, 1> ground{"ground"};
  const Clearance clearance = physics.HullClearance(10.0, ground);
  EXPECT_TRUE(clearance.object.starts_with("person/")) << clearance.object;
  EXPECT_LT(clearance.distance, 1.5 - 0.1 - 0.05);
  EXPECT_GT(clearance.distance, 1.5 - 0.1 - 0.45) << "an arm";
  EXPECT_TRUE(physics.contacts().empty());
  physics.MovePrescribed(testing::At(pelvis));
  EXPECT_LT(physics.HullClearance(10.0).distance, 0.0);
  ASSERT_FALSE(physics.contacts().empty());
  EXPECT_TRUE(physics.contacts().front().object.starts_with("person/"));
}

/// A free body in the way of a walking person is pushed along with the person's velocity, not hit by a wall.
TEST(Actors, PushWhatTheyMeet) {
  const worlds::World world = [] {
    worlds::World made = testing::GroundAndCrate();
    worlds::AddPerson(made, "person", {.route = {{-3, 0, 0}, {3, 0, 0}}, .speed = 1.2, .reactive = false}, 1);
    return made;
  }();
  worlds::ActorSimulation actors(world, 4);
  PhysicsWorld physics(world, testing::PlateOnLegs(), testing::At({-1.5, 0, 1.1}));
  double fastest = 0.0;
  bool touched = false;
  for (int ms = 1; ms <= 2500; ++ms) {
    const Time t = Time{} + Milliseconds(ms);
    actors.Advance(t, {.p_WB = physics.state().X_WB.p, .radius = 0.15});
    physics.MoveActors(actors, t);
    physics.Step({Vec3(0, 0, base::kGravity), Vec3::Zero()}, Milliseconds(1));
    touched = touched || !physics.contacts().empty();
    fastest = std::max(fastest, physics.state().v_WB.x());
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(fastest, 0.8);
  EXPECT_LT(fastest, 4.0) << "swinging arms are faster than the trunk";
}

/// A camera that stands still sees a person walk: later frames differ, and a long exposure smears them.
TEST(Actors, AreWhereTheExposureSaysAndSmearInIt) {
  worlds::World world = testing::GroundAndCrate();
  worlds::AddPerson(world, "person", {.route = {{3.0, -3, 0}, {3.0, 3, 0}}, .speed = 1.6, .reactive = false}, 1);
  SensorsConfig config;
  config.cameras.resize(1);
  config.cameras[0].name = "front";
  config.cameras[0].exposure = Milliseconds(20);
  config.cameras[0].rate = {10, 1};
  const auto film = [&](bool blur, int workers) {
    config.cameras[0].motion_blur = blur;
    const auto renderer = render::MakeRenderer("raster", world, render::MoversOf(world));
    worlds::ActorSimulation actors(world, 2);
    const vehicles::BodyState still = testing::At({0, 0, 1.2});
    SensorSuite suite(config, testing::PlateOnLegs(), Milliseconds(1), 9, "vehicle0", renderer.get(), workers,
                      world.light, &actors);
    suite.Settle(still);
    std::vector<stack::Image> images;
    std::vector<stack::Measurement> measurements;
    for (int ms = 0; ms <= 2000; ++ms) {
      const Time t = Time{} + Milliseconds(ms);
      actors.Advance(t, {.p_WB = still.X_WB.p});
      suite.Measure({Time{} + Milliseconds(std::max(ms - 1, 0)), t, still, still}, {});
      suite.Collect(t, measurements);
      for (const stack::Measurement& m : measurements) {
        if (const auto* image = std::get_if<stack::Image>(&m.data)) images.push_back(*image);
      }
    }
    return images;
  };
  const auto sharp = film(false, 1);
  const auto threaded = film(false, 2);
  const auto smeared = film(true, 1);
  ASSERT_GT(sharp.size(), 15U);
  ASSERT_EQ(sharp.size(), threaded.size());
  for (std::size_t i = 0; i < sharp.size(); ++i) EXPECT_EQ(*sharp[i].bytes, *threaded[i].bytes) << "frame " << i;
  const auto differences = [](const stack::Image& a, const stack::Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.bytes->size(); ++i) count += std::abs((*a.bytes)[i] - (*b.bytes)[i]) > 25;
    return count;
  };
  EXPECT_GT(differences(sharp[8], sharp[14]), 3000U) << "the person has walked on";
  EXPECT_GT(differences(sharp[10], smeared[10]), 200U) << "3 cm of walking within the exposure";
}

}  // namespace
}  // namespace alula::sim
