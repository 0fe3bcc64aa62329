// Textures with holes: what is not there is seen through, in every pass and by the sun, and over the makers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "render/internal/texture_levels.h"
#include "tests/render/agreement.h"
#include "tests/render/each_maker.h"
#include "worlds/furniture.h"
#include "worlds/textures.h"

namespace alula::render {
namespace {

using Holes = test::EachMaker;
using test::LookAt;

std::size_t Index(int u, int v) { return static_cast<std::size_t>(v * 640 + u); }

/// White, there where x < 0.5 of each period.
geometry::Material HalfThere(int side = 64) {
  auto texture = std::make_shared<geometry::Texture>();
  texture->width = texture->height = side;
  texture->rgb.assign(3UL * static_cast<std::size_t>(side * side), 255);
  for (int i = 0; i < side * side; ++i) texture->alpha.push_back(i % side < side / 2 ? 255 : 0);
  return {"half", Eigen::Vector3f::Ones(), texture};
}

// A plate of 2 m at x = 3 in front of a wall at x = 6: its left half (u grows along y of the face) is there.
TEST_P(Holes, AreSeenThroughInEveryPassAndByTheSun) {
  worlds::World world;
  world.light.to_sun_W = {-1, 0, 0};
  world.materials = {test::Plain(0.4F), HalfThere()};
  test::AddBox(world, {base::Quat::Identity(), {6.5, 0, 0}}, {0.5, 20, 20}, 0);
  test::AddBox(world, {base::Quat::Identity(), {3.0, 0, 0}}, {0.01, 1, 1}, 1, 2.0);
  const auto renderer = Make(world);
  const View view = LookAt({0, 0.001, 0}, {1, 0.001, 0});
  const test::Seen seen = test::See(*renderer, {view, {}});
  int there = 0;
  int through = 0;
  int shaded = 0;
  for (int v = 120; v < 354; v += 3) {
    for (int u = 205; u < 440; u += 3) {
      const double depth = static_cast<double>(seen.depth.metres[Index(u, v)]);
      const bool plate = depth < 5.0;
      ASSERT_NEAR(depth, plate ? 2.99 : 6.0, 1e-2);
      ASSERT_EQ(seen.surface.instances[Index(u, v)], plate ? 2U : 1U);
      const int grey = seen.grey.bytes[Index(u, v)];
      ASSERT_EQ(seen.colour.bytes[3 * Index(u, v)], grey);
      there += plate ? 1 : 0;
      through += plate ? 0 : 1;
      shaded += !plate && grey < 70 ? 1 : 0;
      if (plate) {
        ASSERT_GT(grey, 180);
      }
    }
  }
  EXPECT_NEAR(there, through, 0.05 * through);  // half of it is there: one column of pixels on the border
  // From the eye, which stands by the sun's ray, the wall behind the hole is lit but for the border of the shadow.
  EXPECT_LT(shaded, 0.1 * through);
  // A look past the plate: its shadow on the wall is half as wide as it is.
  const View aside = LookAt({3.5, -4, 0}, {6, 0, 0});
  Picture picture;
  renderer->Grey(aside, picture);
  const auto value = [&](double y, double z) -> int {
    const base::Vec2 at = test::Project(aside, {6.0, y, z});
    return picture.bytes[Index(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())))];
  };
  const int lit = value(1.5, 0.0);
  const bool left = value(0.5, 0.0) < lit - 30;
  const bool right = value(-0.5, 0.0) < lit - 30;
  EXPECT_NE(left, right);
  EXPECT_NEAR(value(left ? -0.5 : 0.5, 0.6), lit, 2);
}

TEST(AlphaLevels, KeepTheShareThatIsThere) {
  const auto leaves = worlds::MakeLeafTexture({}, 128, 1, "leaves");
  const geometry::Material material{"leaves", Eigen::Vector3f::Ones(), leaves};
  const auto share = [](const internal::TextureLevel& level) {
    const auto there = std::count_if(level.bytes.begin(), level.bytes.end(), [](std::uint8_t a) { return a >= 128; });
    return static_cast<double>(there) / static_cast<double>(level.bytes.size());
  };
  const std::vector<internal::TextureLevel> levels = internal::AlphaLevels(material);
  ASSERT_EQ(levels.size(), 8U);
  const double first = share(levels.front());
  EXPECT_GT(first, 0.3);
  EXPECT_LT(first, 0.8);
  for (std::size_t i = 0; i + 3 < levels.size(); ++i) EXPECT_NEAR(share(levels[i]), first, 0.03) << i;
  for (const internal::TextureLevel& level : levels) EXPECT_GT(share(level), 0.0);
}

TEST_P(Holes, AlphaThatDoesNotFitIsAFault) {
  worlds::World world;
  auto texture = std::make_shared<geometry::Texture>(*HalfThere().texture);
  texture->alpha.pop_back();
  world.materials = {{"broken", Eigen::Vector3f::Ones(), texture}};
  test::AddBox(world, {base::Quat::Identity(), {2, 0, 0}}, {0.1, 1, 1}, 0);
  Picture picture;
  EXPECT_THROW(Make(world)->Grey(LookAt({0, 0, 0}, {1, 0, 0}), picture), base::FaultError);
}

/// Trees of leaves on clutter.
worlds::World Orchard(std::uint64_t seed) {
  worlds::World world = test::Clutter(seed, 20);
  const auto leaves = worlds::MakeLeafTexture({{0.04F, 0.10F, 0.03F}, {0.62F, 0.80F, 0.35F}}, 256, seed, "leaves");
  const int material = static_cast<int>(world.materials.size());
  world.materials.push_back({"leaves", Eigen::Vector3f::Ones(), leaves});
  base::RandomStream random(seed, "orchard");
  for (int i = 0; i < 6; ++i) {
    const base::Vec2 p(random.Uniform(-7, 7), random.Uniform(-7, 7));
    worlds::AddLeafyTree(world, 3, material, "tree" + std::to_string(i), {p, random.Uniform(0.7, 1.1)}, random);
  }
  return world;
}

// A far crown covers about as much of the picture as its area over distance squared says: it neither vanishes nor
// fills up.
TEST_P(Holes, FarLeavesDoNotVanish) {
  worlds::World world;
  world.materials = {test::Plain(0.3F), {"leaves", Eigen::Vector3f::Ones(), worlds::MakeLeafTexture({}, 256, 1, "x")}};
  base::RandomStream random(2, "tree");
  worlds::AddLeafyTree(world, 0, 1, "tree", {{0, 0}, 1.0}, random);
  world.objects.erase(world.objects.begin());  // without the trunk
  const base::Vec3 middle = world.objects[0].X_WO.p;
  const auto renderer = Make(world);
  std::vector<double> shares;
  for (const double distance : {4.0, 16.0, 48.0}) {
    SurfacePicture surface;
    renderer->Surface(LookAt(middle - base::Vec3(distance, 0, 0), middle), surface);
    const auto seen = std::count(surface.instances.begin(), surface.instances.end(), 1U);
    const double disc = M_PI * std::pow(381.0 / distance, 2);
    shares.push_back(static_cast<double>(seen) / disc);
  }
  EXPECT_GT(shares[0], 0.3);
  EXPECT_NEAR(shares[1], shares[0], 0.25 * shares[0]);
  EXPECT_NEAR(shares[2], shares[0], 0.25 * shares[0]);
}

TEST(HolesOverMakers, LeavesAgree) {
  // A third of an orchard's pixels lie on silhouettes of leaves.
  const std::vector<test::Shot> shots = test::ShotsAbout(3, 4, {8, 8, 3});
  test::ExpectAgreement(Orchard(1), {}, shots, 1.0, 0.5);
  test::ExpectTwins(Orchard(2), {}, shots);
  test::ExpectOsMesaIsEgl(Orchard(3), {}, {shots.front()});
}

// Leaves that move: the holes go with them.
TEST(HolesOverMakers, MoversMayHaveHoles) {
  const std::vector<Mover> movers = {{"sheet", geometry::Box{base::Vec3(0.01, 1.0, 1.0)}, HalfThere(128)}};
  std::vector<test::Shot> shots = test::ShotsAbout(5, 3, {8, 8, 3});
  for (test::Shot& shot : shots) {
    shot.X_WM = {shot.view.X_WC * base::Transform{base::Exp(base::Vec3(0.2, 1.3, 0.1)), {0.1, 0.1, 2.0}}};
  }
  test::ExpectAgreement(test::Clutter(6, 20), movers, shots, 0.5);
  test::ExpectTwins(test::Clutter(6, 20), movers, shots);
}

INSTANTIATE_TEST_SUITE_P(Makers, Holes, test::kEachMaker);

}  // namespace
}  // namespace alula::render
