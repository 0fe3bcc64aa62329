// Two renderers of one scene on two threads give what one renderer gives alone.
#include <gtest/gtest.h>

#include <thread>

#include "base/error.h"
#include "tests/render/test_scene.h"

namespace alula::render {
namespace {

/// Left and right views along a way, with movers that go ahead of the camera.
struct Way {
  std::vector<View> left, right;
  std::vector<std::vector<base::Transform>> movers;
};

Way SomeWay() {
  Way way;
  for (int i = 0; i < 6; ++i) {
    const View view = test::LookAt({-6.0 + i, -4.0, 1.5}, {2.0, 0.5 * i, 1.0});
    way.left.push_back(view);
    way.right.push_back(view);
    way.right.back().X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {0.11, 0, 0}};
    way.movers.push_back({view.X_WC * base::Transform{base::Exp(base::Vec3(0.1 * i, 0.2, 0)), {0.1, 0, 1.5}}});
  }
  return way;
}

struct Pictures {
  std::vector<std::uint8_t> grey, colour;
  std::vector<float> metres;
  bool operator==(const Pictures&) const = default;
};

std::vector<Pictures> Draw(CameraRenderer& renderer, const Way& way, const std::vector<View>& views) {
  std::vector<Pictures> all;
  for (std::size_t i = 0; i < views.size(); ++i) {
    renderer.PlaceMovers(way.movers[i]);
    Picture grey;
    Picture colour;
    DepthPicture depth;
    renderer.Grey(views[i], grey);
    renderer.Colour(views[i], colour);
    renderer.Depth(views[i], depth);
    all.push_back({grey.bytes, colour.bytes, depth.metres});
  }
  return all;
}

class Twin : public testing::TestWithParam<const char*> {};

TEST_P(Twin, OnAnotherThreadGivesTheSameBytesAsOneRenderer) {
  const Way way = SomeWay();
  const std::vector<Mover> movers = {{"ball", geometry::Sphere{0.3}, test::Checker(64, 20, 240)}};
  const worlds::World world = test::Clutter(7, 60);
  std::unique_ptr<CameraRenderer> alone;
  try {
    alone = MakeRenderer(GetParam(), world, movers);
  } catch (const base::InputError& error) {
    GTEST_SKIP() << error.what();
  }
  const std::vector<Pictures> left = Draw(*alone, way, way.left);
  const std::vector<Pictures> right = Draw(*alone, way, way.right);
  // Fresh ones, so that what is made when first needed is made by both at once.
  const std::unique_ptr<CameraRenderer> one = MakeRenderer(GetParam(), world, movers);
  const std::unique_ptr<CameraRenderer> twin = one->Twin();
  EXPECT_EQ(one->Description(), twin->Description());
  std::vector<Pictures> by_twin;
  std::thread thread([&] { by_twin = Draw(*twin, way, way.right); });
  const std::vector<Pictures> by_one = Draw(*one, way, way.left);
  thread.join();
  EXPECT_TRUE(by_one == left);
  EXPECT_TRUE(by_twin == right);
}

INSTANTIATE_TEST_SUITE_P(Makers, Twin, testing::Values("osmesa", "egl", "raster"));

}  // namespace
}  // namespace alula::render
