// Our own rasteriser beside its scalar twin (to the bit) and beside GL (to rounding).
#include <gtest/gtest.h>

#include <cmath>

#include "render/raster/raster_renderer.h"
#include "tests/render/agreement.h"
#include "worlds/courtyard.h"

namespace alula::render {
namespace {

using test::LookAt;

const std::vector<Mover>& Movers() {
  static const std::vector<Mover> movers = {{"cube", geometry::Box{base::Vec3(0.3, 0.2, 0.1)}, test::Plain(0.9F)},
                                            {"ball", geometry::Sphere{0.2}, test::Checker(64, 20, 240)}};
  return movers;
}

std::vector<test::Shot> Shots(std::uint64_t seed, int count, const base::Vec3& reach) {
  std::vector<test::Shot> shots = test::ShotsAbout(seed, count, reach);
  for (test::Shot& shot : shots) {
    const base::Transform ahead{base::Exp(base::Vec3(0.3, 0.2, 0.1)), {0.2, 0.05, 1.1}};
    shot.X_WM = {shot.view.X_WC * ahead, shot.view.X_WC * ahead * ahead};
  }
  return shots;
}

TEST(Raster, ScalarAndAvx2KernelsGiveTheSameBits) {
  test::ExpectTwins(worlds::MakeWorld({}, 3), Movers(), Shots(1, 8, {12, 8, 3}));
  test::ExpectTwins(test::Clutter(3, 100), Movers(), Shots(2, 4, {9, 9, 3}));
}

TEST(Raster, DrawsWhatGlDraws) {
  test::ExpectAgreement(worlds::MakeWorld({}, 5), Movers(), Shots(3, 6, {12, 8, 3}), 0.5);
  test::ExpectAgreement(test::Clutter(8, 100), Movers(), Shots(4, 4, {9, 9, 3}), 0.5);
}

// The eye skims the ground: triangles reach from behind the camera to the horizon, through the near plane.
TEST(Raster, GroundThroughTheNearPlaneIsWholeAndWhereItIs) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {190, 190, 0.5}, 0);
  const auto renderer = MakeRenderer("raster", world, {});
  base::RandomStream random(9, "near");
  for (int pose = 0; pose < 20; ++pose) {
    const double height = random.Uniform(0.02, 0.3);
    const View view = LookAt({random.Uniform(-30, 30), random.Uniform(-30, 30), height},
                             {random.Uniform(-40, 40), random.Uniform(-40, 40), 0.0}, random.Uniform(-3, 3));
    DepthPicture depth;
    renderer->Depth(view, depth);
    for (int v = 0; v < 480; v += 3) {
      for (int u = 0; u < 640; u += 3) {
        const base::Vec3 ray = view.X_WC.q * base::Vec3((u - view.intrinsics.cx) / view.intrinsics.fx,
                                                        (v - view.intrinsics.cy) / view.intrinsics.fy, 1.0);
        const double expected = ray.z() < 0.0 ? -height / ray.z() : 1e9;
        if (expected < 0.0501 || expected > 140.0) continue;  // on the near plane, or near the rim of the ground
        ASSERT_NEAR(depth.metres[static_cast<std::size_t>(v * 640 + u)], expected, std::max(1e-4, 1e-3 * expected))
            << "pose " << pose << " pixel " << u << " " << v;
      }
    }
  }
}

TEST(Raster, NothingNearerThanTheNearPlaneIsDrawn) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  test::AddBox(world, {base::Quat::Identity(), {0.04 + 0.5, 0, 0}}, {0.5, 0.5, 0.5}, 0);
  DepthPicture depth;
  MakeRenderer("raster", world, {})->Depth(LookAt({0, 0, 0}, {1, 0, 0}), depth);
  for (const float metres : depth.metres) ASSERT_EQ(metres, 0.0F);
}

}  // namespace
}  // namespace alula::render
