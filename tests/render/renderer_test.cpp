#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "base/error.h"
#include "tests/render/each_maker.h"
#include "tests/render/test_scene.h"

namespace alula::render {
namespace {

using AnyRenderer = test::EachMaker;
using internal::GlRenderer;
using test::Clutter;
using test::LookAt;

std::vector<View> SomeViews() {
  base::RandomStream random(21, "views");
  std::vector<View> views;
  for (int i = 0; i < 6; ++i) {
    views.push_back(LookAt(test::RandomPose(random, {-6, -6, 0.5}, {6, 6, 2.5}).p,
                           test::RandomPose(random, {-9, -9, 0.0}, {9, 9, 2.0}).p, random.Uniform(-0.3, 0.3)));
  }
  return views;
}

/// All three passes of a view, as one comparable value.
struct Seen {
  std::vector<std::uint8_t> grey, colour;
  std::vector<float> metres;
  bool operator==(const Seen&) const = default;
};

Seen See(CameraRenderer& renderer, const View& view) {
  Picture grey;
  Picture colour;
  DepthPicture depth;
  renderer.Grey(view, grey);
  renderer.Colour(view, colour);
  renderer.Depth(view, depth);
  return {grey.bytes, colour.bytes, depth.metres};
}

std::string MessageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_P(AnyRenderer, SameInputsGiveSameBytesFromRendererToRenderer) {
  const worlds::World world = Clutter(1);
  const auto first = Make(world);
  const auto second = Make(world);  // both alive and used in turns
  for (const View& view : SomeViews()) {
    const Seen seen = See(*first, view);
    EXPECT_TRUE(seen == See(*second, view));
    EXPECT_TRUE(seen == See(*first, view));
  }
}

TEST(Renderer, OsMesaAndEglGiveTheSameBytes) {
  if (!internal::HasOsMesa()) GTEST_SKIP() << "libOSMesa is not installed";
  const worlds::World world = Clutter(2);
  const auto osmesa = MakeRenderer("osmesa", world, {});
  std::unique_ptr<CameraRenderer> egl;
  try {
    egl = MakeRenderer("egl", world, {});
  } catch (const base::InputError& error) {
    GTEST_SKIP() << error.what();
  }
  if (egl->Description().find("llvmpipe") == std::string::npos) GTEST_SKIP() << egl->Description();
  for (const View& view : SomeViews()) {
    const Seen a = See(*osmesa, view);
    const Seen b = See(*egl, view);
    EXPECT_TRUE(a.grey == b.grey);
    EXPECT_TRUE(a.colour == b.colour);
    EXPECT_TRUE(a.metres == b.metres);
  }
}

TEST(Renderer, MayBeUsedFromOneThreadAfterAnother) {
  for (const char* maker : {"osmesa", "egl", "raster"}) {
    std::unique_ptr<CameraRenderer> renderer;
    try {
      renderer = MakeRenderer(maker, Clutter(3, 20), {});
    } catch (const base::InputError& error) {
      continue;  // not installed here; the other one is tested
    }
    const View view = SomeViews().front();
    const Seen here = See(*renderer, view);
    Seen there;
    std::thread([&] { there = See(*renderer, view); }).join();
    EXPECT_TRUE(here == there) << maker;
    std::thread([&] { renderer.reset(); }).join();
  }
}

TEST(Renderer, CullingDoesNotChangeThePicture) {
  const worlds::World world = Clutter(4, 120);
  GlRenderer culled(test::MakeContext("osmesa"), world, {}, {.cull = true});
  GlRenderer whole(test::MakeContext("osmesa"), world, {}, {.cull = false});
  for (const View& view : SomeViews()) EXPECT_TRUE(See(culled, view) == See(whole, view));
}

TEST(Renderer, SaysWhatItIsMadeOf) {
  const auto renderer = MakeRenderer("osmesa", Clutter(5, 0), {});
  EXPECT_NE(renderer->Description().find("OpenGL"), std::string::npos);
  EXPECT_EQ(MakeRenderer("raster", {}, {})->Description().substr(0, 7), "raster ");
}

TEST(Renderer, UnknownAndMissingMakersAreBadInput) {
  EXPECT_EQ(MessageOf([] { MakeRenderer("vulkan", {}, {}); }),
            "renderer \"vulkan\" is not known; it can be osmesa, egl, raster or auto");
  EXPECT_EQ(MessageOf([] { internal::MakeOsMesaContext({"libOSMesa.so.0"}); }),
            "renderer \"osmesa\" is not available: libOSMesa.so.0 cannot be loaded; install libosmesa6 or choose "
            "\"egl\"");
  EXPECT_EQ(MessageOf([] { internal::MakeEglContext({"libEGL.so.0"}); }),
            "renderer \"egl\" is not available: libEGL.so.0 cannot be loaded; install libegl1 or choose \"osmesa\"");
}

TEST_P(AnyRenderer, EmptyWorldIsSkyThatIsBrightestAtTheHorizon) {
  const auto renderer = Make({});
  Picture picture;
  renderer->Grey(LookAt({0, 0, 1}, {1, 0, 1.6}), picture);
  const auto row = [&](int v) { return picture.bytes[static_cast<std::size_t>(v * 640 + 320)]; };
  EXPECT_GT(row(460), row(240));  // the horizon lies below the picture
  EXPECT_GT(row(240), row(5));
  DepthPicture depth;
  renderer->Depth(LookAt({0, 0, 1}, {1, 0, 1}), depth);
  EXPECT_TRUE(std::all_of(depth.metres.begin(), depth.metres.end(), [](float m) { return m == 0.0F; }));
}

TEST_P(AnyRenderer, MoversStandWhereTheyArePutAndOnlyWhereWanted) {
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {test::Plain(0.2F)};
  test::AddBox(world, {base::Quat::Identity(), {8, 0, 0}}, {0.1, 20, 20}, 0);
  const std::vector<Mover> movers = {{"cube", geometry::Box{base::Vec3::Constant(0.25)}, test::Plain(0.9F)},
                                     {"ball", geometry::Sphere{0.2}, test::Plain(0.6F)}};
  const auto renderer = Make(world, movers);
  View view = LookAt({0, 0, 0}, {1, 0, 0});
  for (const double y : {-1.0, 0.4, 1.1}) {
    const std::vector<base::Transform> poses = {{base::Quat::Identity(), {3, y, 0}},
                                                {base::Quat::Identity(), {3, -y, 1}}};
    renderer->PlaceMovers(poses);
    Picture picture;
    DepthPicture depth;
    renderer->Grey(view, picture);
    renderer->Depth(view, depth);
    const base::Vec2 at = test::Project(view, {2.75, y, 0});
    const auto i = static_cast<std::size_t>(std::lround(at.y()) * 640 + std::lround(at.x()));
    EXPECT_GT(picture.bytes[i], 150);
    EXPECT_NEAR(depth.metres[i], 2.75, 1e-3);
  }
  Picture without;
  view.draw_movers = false;
  renderer->Grey(view, without);
  Picture alone;
  Make(world)->Grey(view, alone);
  EXPECT_TRUE(without.bytes == alone.bytes);
  EXPECT_THROW(renderer->PlaceMovers({}), base::FaultError);
}

TEST_P(AnyRenderer, FarTexturesFadeToTheirMeanInsteadOfFlickering) {
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {test::Checker(256, 40, 200)};
  test::AddBox(world, {base::Quat::Identity(), {60, 0, 0}}, {0.1, 200, 200}, 0, 0.5);
  const auto renderer = Make(world);
  Picture picture;
  renderer->Grey(LookAt({0, 0, 0}, {1, 0, 0}), picture);
  // A period of 0.5 m at 60 m is 3 px, a field 0.4 px: the mean, 120, under a wall's share of the sky light.
  const auto [low, high] = std::minmax_element(picture.bytes.begin(), picture.bytes.end());
  EXPECT_LT(*high - *low, 40);  // of 160 near by
}

TEST_P(AnyRenderer, LongAndPlainTexturesAreDrawn) {
  auto strip = std::make_shared<geometry::Texture>();
  strip->width = 64;
  strip->height = 2;
  strip->rgb.assign(64UL * 2 * 3, 128);
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {{"strip", Eigen::Vector3f::Ones(), strip}};
  test::AddBox(world, {base::Quat::Identity(), {2, 0, 0}}, {0.1, 20, 20}, 0);
  Picture picture;
  const auto renderer = Make(world);
  renderer->Colour(LookAt({0, 0, 0}, {1, 0, 0}), picture);
  EXPECT_EQ(*std::min_element(picture.bytes.begin(), picture.bytes.end()),
            *std::max_element(picture.bytes.begin(), picture.bytes.end()));
  strip->rgb.pop_back();
  EXPECT_THROW(Make(world)->Grey(LookAt({0, 0, 0}, {1, 0, 0}), picture), base::FaultError);
}

// A plate that hovers at 1 m casts its shadow along the sun's ray; elsewhere the ground is evenly lit (no acne).
TEST_P(AnyRenderer, ShadowsFallAlongTheSun) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  world.light.to_sun_W = base::Vec3(0.5, 0.3, 0.8).normalized();
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {10, 10, 0.5}, 0);
  test::AddBox(world, {base::Quat::Identity(), {0, 0, 1.0}}, {0.3, 0.3, 0.02}, 0);
  const auto renderer = Make(world);
  const View view = LookAt({-3, -0.3, 0.9}, {-0.6, -0.3, 0});
  Picture picture;
  renderer->Grey(view, picture);
  const auto value = [&](double x, double y) -> int {
    const base::Vec2 at = test::Project(view, {x, y, 0});
    return picture.bytes[static_cast<std::size_t>(std::lround(at.y()) * 640 + std::lround(at.x()))];
  };
  const base::Vec2 middle = -world.light.to_sun_W.head<2>() / world.light.to_sun_W.z();
  const int lit = value(-1.8, 0.2);
  EXPECT_LT(value(middle.x(), middle.y()), lit - 40);
  for (double x = -0.26; x < 0.27; x += 0.04) {
    EXPECT_EQ(value(middle.x() + x, middle.y()), value(middle.x(), middle.y()));
    EXPECT_EQ(value(middle.x() + x, middle.y() + 0.36), lit);
    EXPECT_EQ(value(middle.x() + x, middle.y() - 0.36), lit);
  }
}

// Three levels of a dark scene become many again where the gain lies before the rounding, and bright ones stop at 255.
TEST_P(AnyRenderer, BrightnessScalesTheSignalBeforeItIsRounded) {
  worlds::World world = Clutter(7);
  world.light.sun *= 0.0025F;
  world.light.ambient *= 0.0025F;
  world.light.sky *= 0.05F;
  const auto dark = Make(world);
  world.light.sun *= 400.0F;
  world.light.ambient *= 400.0F;
  const auto bright = Make(world);
  DepthPicture depth;
  for (View view : SomeViews()) {
    bright->Depth(view, depth);
    for (const bool colour : {false, true}) {
      Picture expected;
      Picture picture;
      colour ? bright->Colour(view, expected) : bright->Grey(view, expected);
      View gained = view;
      gained.brightness = 20.0F;  // light enters by its root
      colour ? dark->Colour(gained, picture) : dark->Grey(gained, picture);
      const auto bytes_a_pixel = static_cast<std::size_t>(picture.channels);
      for (std::size_t i = 0; i < picture.bytes.size(); ++i) {
        if (depth.metres[i / bytes_a_pixel] == 0.0F) continue;     // the sky has its own light
        ASSERT_NEAR(picture.bytes[i], expected.bytes[i], 1) << i;  // roots and products are rounded
      }
    }
  }
}

TEST_P(AnyRenderer, BrightnessScalesTheSkyAndStopsAt255) {
  const auto renderer = Make({});
  View view = LookAt({0, 0, 1}, {1, 0, 1.6});
  Picture nominal;
  Picture half;
  Picture full;
  renderer->Colour(view, nominal);
  view.brightness = 0.5F;
  renderer->Colour(view, half);
  view.brightness = 100.0F;
  renderer->Colour(view, full);
  for (std::size_t i = 0; i < nominal.bytes.size(); ++i) {
    ASSERT_NEAR(half.bytes[i], 0.5 * nominal.bytes[i], 0.76);  // two roundings: half a level and a quarter
    ASSERT_EQ(full.bytes[i], 255);
  }
  for (const float wrong : {-0.1F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    view.brightness = wrong;
    EXPECT_THROW(renderer->Colour(view, full), base::InputError);
  }
}

INSTANTIATE_TEST_SUITE_P(Makers, AnyRenderer, test::kEachMaker);

}  // namespace
}  // namespace alula::render
