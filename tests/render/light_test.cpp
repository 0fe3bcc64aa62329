// Fog, lamps and the infrared against closed forms, and over the makers.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "render/internal/projection.h"
#include "render/passes.h"
#include "tests/render/agreement.h"
#include "tests/render/each_maker.h"
#include "worlds/courtyard.h"

namespace alula::render {
namespace {

using Light = test::EachMaker;
using internal::RayDirection;
using test::LookAt;

std::size_t Index(int u, int v) { return static_cast<std::size_t>(v * 640 + u); }

/// Ground z = 0 of even grey without any light.
worlds::World DarkGround(float grey) {
  worlds::World world;
  world.materials = {test::Plain(grey)};
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {40, 40, 0.5}, 0);
  world.light.sun = 0.0F;
  world.light.ambient = 0.0F;
  world.light.sky_brightness = 0.0F;
  return world;
}

/// The law of worlds/lighting.h, as it is written down there.
double LightOf(const worlds::Lamp& lamp, const base::Vec3& p, const base::Vec3& normal) {
  const base::Vec3 to = lamp.position - p;
  const double r = to.norm();
  const double facing = std::max(normal.dot(to) / r, 0.0);
  double spot = 1.0;
  if (lamp.cone < 3.14159) {
    const double c = -lamp.direction.normalized().dot(to) / r;
    const double t = (c - std::cos(lamp.cone)) / (lamp.softness * (1.0 - std::cos(lamp.cone)));
    const double s = std::clamp(t, 0.0, 1.0);
    spot = s * s * (3.0 - 2.0 * s);
  }
  const double fade = std::max(1.0 - std::pow(r / lamp.range, 4), 0.0);
  return lamp.intensity * spot * fade * fade * facing / (r * r);
}

TEST_P(Light, LampsFallOffAndSpotsEndAsTheLawSays) {
  worlds::World world = DarkGround(0.5F);
  world.light.lamps = {{.position = {0.5, 0.4, 1.5}, .intensity = 1.2, .colour = {1.0, 0.5, 0.25}, .range = 6.0},
                       {.position = {3.0, -1.0, 2.5}, .direction = {0.2, 0.3, -1}, .cone = 0.5, .intensity = 4.0}};
  const auto renderer = Make(world);
  const View view = LookAt({-2.0, 0.3, 1.8}, {2.0, -0.2, 0.0}, 0.1);
  Picture colour;
  Picture grey;
  renderer->Colour(view, colour);
  renderer->Grey(view, grey);
  int brightest = 0;
  int darkest = 255;
  for (int v = 0; v < 480; v += 3) {
    for (int u = 0; u < 640; u += 3) {
      const base::Vec3 ray = RayDirection(view, u, v);
      if (ray.z() > -0.05) continue;  // sky, and the rim of the ground
      const base::Vec3 p = view.X_WC.p - ray * (view.X_WC.p.z() / ray.z());
      const base::Vec3 rgb = LightOf(world.light.lamps[0], p, base::Vec3::UnitZ()) * world.light.lamps[0].colour +
                             LightOf(world.light.lamps[1], p, base::Vec3::UnitZ()) * base::Vec3::Ones();
      const auto displayed = [](double light) { return std::min(127.5 * std::sqrt(light), 255.0); };
      // 127.5 is held as 128 in a texture of bytes: half a per cent.
      for (int c = 0; c < 3; ++c) {
        const double expected = displayed(rgb[c]);
        ASSERT_NEAR(colour.bytes[3 * Index(u, v) + static_cast<std::size_t>(c)], expected, 1.0 + 0.005 * expected);
      }
      const double luma = displayed(rgb.dot(base::Vec3(0.299, 0.587, 0.114)));
      ASSERT_NEAR(grey.bytes[Index(u, v)], luma, 1.0 + 0.005 * luma) << u << " " << v;
      brightest = std::max<int>(brightest, grey.bytes[Index(u, v)]);
      darkest = std::min<int>(darkest, grey.bytes[Index(u, v)]);
    }
  }
  EXPECT_GT(brightest, 100);
  EXPECT_LT(darkest, 5);
}

// A torch on the camera: a wall straight ahead is lit by intensity / distance².
TEST_P(Light, LampsOnTheCameraRideWithIt) {
  for (const double distance : {1.0, 2.0, 4.0}) {
    worlds::World world = DarkGround(1.0F);
    test::AddBox(world, {base::Quat::Identity(), {3.0, 0, 3}}, {0.5, 20, 10}, 0);
    const auto renderer = Make(world);
    View view = LookAt({2.5 - distance, 0, 3}, {2.5, 0, 3}, 0.3);
    Picture picture;
    renderer->Grey(view, picture);
    const std::size_t middle = Index(323, 237);
    EXPECT_EQ(picture.bytes[middle], 0);
    view.lamps = {{.cone = 0.6, .intensity = 0.9, .range = 1000.0}};
    renderer->Grey(view, picture);
    EXPECT_NEAR(picture.bytes[middle], 255.0 * std::sqrt(0.9) / distance, 1.0);
    view.brightness = 0.5F;
    renderer->Grey(view, picture);
    EXPECT_NEAR(picture.bytes[middle], 127.5 * std::sqrt(0.9) / distance, 1.0);
    EXPECT_EQ(picture.bytes[Index(5, 5)], 0);  // outside the cone
  }
}

TEST_P(Light, FogFollowsKoschmieder) {
  worlds::World clear = test::Clutter(41);
  worlds::World foggy = clear;
  foggy.light.fog = worlds::Fog{.visibility = 25.0, .height = 4.0, .colour = {0.6, 0.65, 0.7}};
  const auto without = Make(clear);
  const auto with = Make(foggy);
  const View view = LookAt({-9, 1, 1.4}, {3, 0, 1.9}, 0.1);
  Picture seen;
  Picture fogged;
  DepthPicture depth;
  RangePicture range;
  without->Colour(view, seen);
  with->Colour(view, fogged);
  without->Depth(view, depth);
  RangeFromDepth(view, depth, range);
  const double extinction = std::log(50.0) / 25.0;
  int sky = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double up = RayDirection(view, u, v).normalized().z();
      const bool is_sky = range.metres[Index(u, v)] == 0.0F;
      sky += is_sky ? 1 : 0;
      double r = static_cast<double>(range.metres[Index(u, v)]);
      if (is_sky) r = up > 0.0 ? 4.0 / up : 1e9;
      const double share = std::exp(-extinction * r);
      for (std::size_t c = 0; c < 3; ++c) {
        const double before = seen.bytes[3 * Index(u, v) + c];
        const double fog = 255.0 * foggy.light.fog->colour[static_cast<int>(c)];
        const double expected = std::sqrt(before * before * share + fog * fog * (1.0 - share));
        // Half a level of either picture's rounding, and 255 for what was brighter.
        const double tolerance = before == 255.0 ? 40.0 : 1.1;
        ASSERT_NEAR(fogged.bytes[3 * Index(u, v) + c], expected, tolerance) << u << " " << v << " " << c;
      }
    }
  }
  EXPECT_GT(sky, 1000);
}

TEST_P(Light, InfraredShowsMaterialsByTheirOwnFactor) {
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {test::Plain(0.3F), test::Plain(0.3F)};
  world.materials[1].infrared = 2.0F;
  test::AddBox(world, {base::Quat::Identity(), {3, 2, 0}}, {0.5, 1.9, 2}, 0);
  test::AddBox(world, {base::Quat::Identity(), {3, -2, 0}}, {0.5, 1.9, 2}, 1);
  const auto renderer = Make(world);
  View view = LookAt({0, 0, 0}, {1, 0, 0});
  Picture visible;
  Picture infrared;
  renderer->Grey(view, visible);
  view.infrared = true;
  renderer->Grey(view, infrared);
  const std::size_t left = Index(200, 240);
  const std::size_t right = Index(440, 240);
  EXPECT_EQ(visible.bytes[left], visible.bytes[right]);
  EXPECT_EQ(infrared.bytes[left], visible.bytes[left]);
  EXPECT_NEAR(infrared.bytes[right], 2.0 * visible.bytes[right], 2.0);
}

TEST_P(Light, WhatCannotBeIsBadInput) {
  worlds::World world = DarkGround(0.5F);
  world.light.fog = worlds::Fog{.visibility = -1.0};
  EXPECT_THROW(Make(world), base::InputError);
  world.light.fog.reset();
  world.light.lamps = {{.cone = 3.5}};
  EXPECT_THROW(Make(world), base::InputError);
  world.light.lamps.assign(33, {});
  EXPECT_THROW(Make(world), base::InputError);
  world.light.lamps.pop_back();
  const auto renderer = Make(world);
  Picture picture;
  View view = LookAt({0, 0, 1}, {1, 0, 1});
  view.lamps.assign(8, {});
  renderer->Grey(view, picture);
  view.lamps.push_back({});
  EXPECT_THROW(renderer->Grey(view, picture), base::InputError);
  view.lamps = {{.intensity = std::nan("")}};
  EXPECT_THROW(renderer->Grey(view, picture), base::InputError);
}

const worlds::CourtyardConfig kSmall{.texture_size = 128};

worlds::World Night(worlds::World world) {
  world.light.sun = 0.0F;
  world.light.ambient = 0.01F;
  world.light.sky_brightness = 0.05F;
  world.light.lamps = {
      {.position = {4, 3, 3.5}, .intensity = 8.0, .colour = {1.0, 0.8, 0.5}},
      {.position = {-5, -2, 3}, .direction = {0.3, 0.1, -1}, .cone = 0.9, .intensity = 12.0},
      {.position = {-3, 6, 2.5}, .intensity = 3.0, .colour = {0.5, 0.7, 1.0}, .range = 9.0},
  };
  return world;
}
worlds::World InFog(worlds::World world) {
  world.light.fog = worlds::Fog{.visibility = 18.0};
  return world;
}
std::vector<test::Shot> TorchShots(std::uint64_t seed) {
  std::vector<test::Shot> shots = test::ShotsAbout(seed, 3, {9, 7, 3});
  for (test::Shot& shot : shots) {
    shot.view.lamps = {{.position = {0.05, 0, 0}, .cone = 0.7, .intensity = 4.0}};
    shot.view.brightness = 1.3F;
    shot.view.infrared = true;
  }
  return shots;
}

TEST(LightOverMakers, NightAndFogAgree) {
  test::ExpectAgreement(Night(worlds::MakeWorld(kSmall, 5)), {}, TorchShots(3), 0.5);
  test::ExpectAgreement(InFog(worlds::MakeWorld(kSmall, 6)), {}, test::ShotsAbout(4, 3, {9, 7, 3}), 0.5);
  test::ExpectAgreement(InFog(Night(test::Clutter(8, 100))), {}, TorchShots(5), 0.5);
}

TEST(LightOverMakers, ScalarAndAvx2KernelsGiveTheSameBits) {
  test::ExpectTwins(InFog(Night(test::Clutter(9))), {}, TorchShots(6));
  test::ExpectTwins(Night(test::Clutter(10)), {}, TorchShots(7));
}

TEST(LightOverMakers, OsMesaAndEglGiveTheSameBytes) {
  test::ExpectOsMesaIsEgl(InFog(Night(test::Clutter(11))), {}, TorchShots(8));
}

INSTANTIATE_TEST_SUITE_P(Makers, Light, test::kEachMaker);

}  // namespace
}  // namespace alula::render
