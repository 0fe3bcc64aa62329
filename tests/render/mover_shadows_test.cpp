// Shadows of what moves: where a static thing's would be, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/agreement.h"
#include "tests/render/each_maker.h"

namespace alula::render {
namespace {

using MoverShadows = test::EachMaker;
using test::LookAt;

/// Ground and a post that is higher than all that moves, so that the sun's frame is the same with a plate and without.
worlds::World Ground() {
  worlds::World world;
  world.materials = {test::Plain(0.5F), test::Plain(0.8F)};
  world.light.to_sun_W = base::Vec3(0.5, 0.3, 0.8).normalized();
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {10, 10, 0.5}, 0);
  test::AddBox(world, {base::Quat::Identity(), {6, 6, 2}}, {0.1, 0.1, 2}, 0);
  return world;
}
const geometry::Shape kPlate = geometry::Box{base::Vec3(0.3, 0.4, 0.05)};
std::vector<Mover> Plate() { return {{"plate", kPlate, test::Plain(0.8F)}}; }
base::Transform At(double x, double y, double z) { return {base::Exp(base::Vec3(0.2, -0.3, 0.5)), {x, y, z}}; }

std::vector<std::uint8_t> Grey(CameraRenderer& renderer, const View& view) {
  Picture picture;
  renderer.Grey(view, picture);
  return picture.bytes;
}

TEST_P(MoverShadows, AreThoseOfAStaticThingAtTheSamePlace) {
  worlds::World with_static = Ground();
  with_static.objects.push_back({"plate", kPlate, At(0.2, 0.1, 1.3), 1});
  const View view = LookAt({-3, -0.3, 1.9}, {-0.3, -0.1, 0.3});
  const auto fixed = Make(with_static);
  const auto moving = Make(Ground(), Plate());
  const std::vector<base::Transform> pose = {At(0.2, 0.1, 1.3)};
  moving->PlaceMovers(pose);
  const std::vector<std::uint8_t> expected = Grey(*fixed, view);
  const std::vector<std::uint8_t> seen = Grey(*moving, view);
  int other = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) other += std::abs(seen[i] - expected[i]) > 2 ? 1 : 0;
  EXPECT_LT(other, 30);  // outlines, where single precision puts a corner on the other side
  // The shadow lies along the sun's ray.
  const base::Vec3 to_sun = Ground().light.to_sun_W;
  const base::Vec3 spot = pose[0].p - to_sun * (pose[0].p.z() / to_sun.z());
  const base::Vec2 at = test::Project(view, spot);
  const auto i = static_cast<std::size_t>(std::lround(at.y()) * 640 + std::lround(at.x()));
  const std::vector<std::uint8_t> alone = Grey(*Make(Ground()), view);
  EXPECT_LT(seen[i], alone[i] - 40);
}

TEST_P(MoverShadows, LeaveNothingBehind) {
  const View view = LookAt({-4, -0.3, 2.9}, {-0.3, -0.1, 0.3});
  const auto renderer = Make(Ground(), Plate());
  base::RandomStream random(2, "moves");
  for (int move = 0; move < 8; ++move) {
    // Also beside the ground, above the post and under the ground.
    const std::vector<base::Transform> pose = {
        At(random.Uniform(-3, 3), random.Uniform(-3, 3), move == 5 ? 6.0 : random.Uniform(-0.5, 2.0))};
    const std::vector<base::Transform> away = {At(move == 3 ? 30.0 : 0.0, -2.0, 1.0)};
    renderer->PlaceMovers(away);
    Grey(*renderer, view);
    renderer->PlaceMovers(pose);
    const auto fresh = Make(Ground(), Plate());
    fresh->PlaceMovers(pose);
    ASSERT_TRUE(Grey(*renderer, view) == Grey(*fresh, view)) << move;
    ASSERT_TRUE(Grey(*renderer, view) == Grey(*fresh, view)) << move;  // and again, where nothing has moved
  }
}

TEST_P(MoverShadows, StayWhereTheMoverItselfIsNotDrawn) {
  View view = LookAt({-3, -0.3, 0.9}, {-0.6, -0.3, 0});
  view.draw_movers = false;
  const auto renderer = Make(Ground(), Plate());
  const std::vector<base::Transform> pose = {At(0.2, 0.1, 1.3)};
  renderer->PlaceMovers(pose);
  const std::vector<std::uint8_t> seen = Grey(*renderer, view);
  const std::vector<std::uint8_t> alone = Grey(*Make(Ground()), view);
  int darker = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ASSERT_LE(seen[i], alone[i]);
    darker += seen[i] < alone[i] - 20 ? 1 : 0;
  }
  EXPECT_GT(darker, 2000);
  // Under the ground it casts none.
  const std::vector<base::Transform> under = {At(0.2, 0.1, -3.0)};
  renderer->PlaceMovers(under);
  EXPECT_TRUE(Grey(*renderer, view) == alone);
}

// Above all that stands, beyond the sun's frame: GL holds the depth, our own nearness is held too.
TEST_P(MoverShadows, FallFromAboveAllThatStands) {
  const auto renderer = Make(Ground(), Plate());
  const View view = LookAt({-9, -5, 2.0}, {-4, -2.5, 0});
  const std::vector<base::Transform> pose = {At(0.0, 0.0, 7.0)};
  renderer->PlaceMovers(pose);
  const std::vector<std::uint8_t> seen = Grey(*renderer, view);
  const std::vector<std::uint8_t> alone = Grey(*Make(Ground()), view);
  int darker = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) darker += seen[i] < alone[i] - 20 ? 1 : 0;
  EXPECT_GT(darker, 200);
}

TEST(MoverShadowsOverMakers, Agree) {
  std::vector<Mover> movers = Plate();
  movers.push_back({"ball", geometry::Sphere{0.4}, test::Checker(64, 20, 240)});
  std::vector<test::Shot> shots = test::ShotsAbout(9, 4, {8, 8, 3});
  for (test::Shot& shot : shots) {
    const base::Transform ahead{base::Exp(base::Vec3(0.3, 0.2, 0.1)), {0.1, -0.2, 2.2}};
    shot.X_WM = {shot.view.X_WC * ahead, shot.view.X_WC * ahead * ahead};
  }
  const worlds::World world = test::Clutter(12, 40);
  test::ExpectAgreement(world, movers, shots, 0.5);
  test::ExpectTwins(world, movers, shots);
  test::ExpectOsMesaIsEgl(world, movers, shots);
}

INSTANTIATE_TEST_SUITE_P(Makers, MoverShadows, test::kEachMaker);

}  // namespace
}  // namespace alula::render
