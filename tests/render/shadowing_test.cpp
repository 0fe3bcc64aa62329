// What the rasteriser knows of shadows before it looks: beside the bilinear look into the map itself.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "render/raster/raster_scene.h"
#include "tests/render/test_scene.h"

namespace alula::render::raster {
namespace {

/// Ground, a roof over a part of it, posts and balls: large triangles and small ones, in light and in shadow.
worlds::World Yard() {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  world.light.to_sun_W = base::Vec3(0.5, 0.3, 0.8).normalized();
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {8, 8, 0.5}, 0);
  test::AddBox(world, {base::Quat::Identity(), {-2, 1, 2.5}}, {2, 3, 0.1}, 0);
  base::RandomStream random(3, "yard");
  for (int i = 0; i < 12; ++i) {
    const base::Vec3 at(random.Uniform(-7, 7), random.Uniform(-7, 7), 0.6);
    if (i % 2 == 0) {
      test::AddBox(world, {base::FromYaw(random.Uniform(0, 3)), at}, {0.2, 0.3, 0.6}, 0);
    } else {
      world.objects.push_back({"ball", geometry::Sphere{0.5}, {base::Quat::Identity(), at}, 0, 1.0, true});
    }
  }
  return world;
}

/// The look-up at a place of the map as its definition has it: weights of the four nearest texels that lie no nearer to
/// the sun than `away`.
double LightAt(const ShadowMap& map, double x, double y, double away) {
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  double light = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int u = x0 + i % 2, v = y0 + i / 2;
    const double weight = (1.0 - std::abs(x - u)) * (1.0 - std::abs(y - v));
    const auto word = map.At(u, v);
    if (std::floor(away) <= word + 32768.0) light += weight;
  }
  return light;
}

/// What the table says of the look-up at (x, y) on a triangle.
Shadowing Claimed(const ShadowingTable& table, std::size_t triangle, double x, double y) {
  const std::uint32_t entry = table.of_triangle[triangle];
  if (entry < kFirstShadowingGrid) return static_cast<Shadowing>(entry);
  const ShadowingGrid& grid = table.grids[entry - kFirstShadowingGrid];
  const int column = (static_cast<int>(x) - grid.x0) / kShadowingBlock;
  const int row = (static_cast<int>(y) - grid.y0) / kShadowingBlock;
  EXPECT_TRUE(column < grid.columns && row < grid.rows);
  return table.blocks[grid.first + static_cast<std::size_t>(row * grid.columns + column)];
}

TEST(Shadowing, IsWhatTheMapSays) {
  const RasterScene scene(internal::BuildScene(Yard(), {}), ScalarKernels());
  base::RandomStream random(4, "places");
  std::map<Shadowing, int> claims;
  for (std::size_t triangle = 0; triangle < scene.triangles(); ++triangle) {
    std::array<Eigen::Vector3d, 3> corners;
    double sun = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const float* attributes = scene.attributes() + std::size_t{scene.corners(i)[triangle]} * kAttributes;
      corners[i] = Eigen::Vector3f(attributes[5], attributes[6], attributes[7]).cast<double>();
      sun = std::max(sun, static_cast<double>(attributes[4]));
    }
    if (sun == 0.0) continue;  // turned away: the look-up weighs nothing
    const Eigen::Vector3d a3 = corners[1] - corners[0];
    const Eigen::Vector3d b3 = corners[2] - corners[0];
    const double area = std::abs(a3.x() * b3.y() - a3.y() * b3.x());  // texels², twice
    const int places = area > 1e4 ? 20000 : 50;
    for (int place = 0; place < places; ++place) {
      double a = random.Uniform(0, 1);
      double b = random.Uniform(0, 1);
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      const Eigen::Vector3d at = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
      const Shadowing claimed = Claimed(scene.shadowing(), triangle, at.x(), at.y());
      ++claims[claimed];
      if (claimed == Shadowing::kMixed) continue;
      const double expected = claimed == Shadowing::kLit ? 1.0 : 0.0;
      ASSERT_NEAR(LightAt(scene.shadow_map(), at.x(), at.y(), at.z()), expected, 1e-9) << triangle;
    }
  }
  // Most of it is known, and all three kinds are met.
  EXPECT_GT(claims[Shadowing::kDark], 1000);
  EXPECT_GT(claims[Shadowing::kLit], 5 * claims[Shadowing::kMixed]);
  EXPECT_GT(claims[Shadowing::kMixed], 100);
}

}  // namespace
}  // namespace alula::render::raster
