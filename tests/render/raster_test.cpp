// Our own rasteriser beside its scalar twin (to the bit) and beside GL (to rounding).
#include <gtest/gtest.h>

#include <cmath>

#include "render/raster/raster_renderer.h"
#include "tests/render/test_scene.h"
#include "worlds/courtyard.h"

namespace alula::render {
namespace {

using raster::RasterRenderer;
using test::LookAt;

std::vector<View> Poses(std::uint64_t seed, int count, const base::Vec3& reach) {
  base::RandomStream random(seed, "poses");
  std::vector<View> views;
  for (int i = 0; i < count; ++i) {
    const base::Vec3 low(-reach.x(), -reach.y(), 0.4);
    views.push_back(LookAt(test::RandomPose(random, low, reach).p, test::RandomPose(random, 1.5 * low, 1.5 * reach).p,
                           random.Uniform(-0.4, 0.4)));
  }
  return views;
}

struct Seen {
  Picture grey, colour;
  DepthPicture depth;
};
Seen See(CameraRenderer& renderer, const View& view) {
  Seen seen;
  renderer.Grey(view, seen.grey);
  renderer.Colour(view, seen.colour);
  renderer.Depth(view, seen.depth);
  return seen;
}

const std::vector<Mover>& Movers() {
  static const std::vector<Mover> movers = {{"cube", geometry::Box{base::Vec3(0.3, 0.2, 0.1)}, test::Plain(0.9F)},
                                            {"ball", geometry::Sphere{0.2}, test::Checker(64, 20, 240)}};
  return movers;
}

void ExpectTwins(const worlds::World& world, std::vector<View> views) {
  const raster::Kernels* avx2 = raster::Avx2KernelsOrNull();
  if (avx2 == nullptr) GTEST_SKIP() << "this processor has no AVX2";
  RasterRenderer fast(*avx2, world, Movers());
  RasterRenderer twin(raster::ScalarKernels(), world, Movers());
  EXPECT_EQ(fast.Description(), "raster avx2");
  EXPECT_EQ(twin.Description(), "raster scalar");
  views.front().intrinsics.width = 333;  // no multiple of a tile
  views.front().intrinsics.height = 101;
  for (const View& view : views) {
    const base::Transform ahead{base::Exp(base::Vec3(0.3, 0.2, 0.1)), {0.1, 0.05, 0.9}};
    const std::vector<base::Transform> poses = {view.X_WC * ahead, view.X_WC * ahead * ahead};
    fast.PlaceMovers(poses);
    twin.PlaceMovers(poses);
    const Seen a = See(fast, view);
    const Seen b = See(twin, view);
    EXPECT_TRUE(a.grey.bytes == b.grey.bytes);
    EXPECT_TRUE(a.colour.bytes == b.colour.bytes);
    EXPECT_TRUE(a.depth.metres == b.depth.metres);
  }
}

TEST(Raster, ScalarAndAvx2KernelsGiveTheSameBits) {
  ExpectTwins(worlds::MakeCourtyard({}, 3), Poses(1, 8, {12, 8, 3}));
  ExpectTwins(test::Clutter(3, 100), Poses(2, 4, {9, 9, 3}));
}

/// How two makers differ where no silhouette is near: depth steps of less than 2 % among the 3×3 neighbours.
struct Difference {
  double pixels = 0.0;
  double grey = 0.0;  // sums of absolute differences, levels
  double colour = 0.0;
  double wrong_depth = 0.0;  // pixels that differ by more than 1 mm and 0.1 %
};

bool IsSilhouette(const DepthPicture& depth, int u, int v) {
  constexpr float kStep = 0.02F;
  const auto at = [&](int x, int y) { return depth.metres[static_cast<std::size_t>(y * depth.width + x)]; };
  const float here = at(u, v);
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      if ((at(x, y) > 0.0F) != (here > 0.0F) || std::abs(at(x, y) - here) > kStep * here) return true;
    }
  }
  return false;
}

void Add(const Seen& a, const Seen& b, Difference& sum) {
  for (int v = 1; v + 1 < a.depth.height; ++v) {
    for (int u = 1; u + 1 < a.depth.width; ++u) {
      if (IsSilhouette(a.depth, u, v) || IsSilhouette(b.depth, u, v)) continue;
      const auto i = static_cast<std::size_t>(v * a.depth.width + u);
      sum.pixels += 1.0;
      sum.grey += std::abs(a.grey.bytes[i] - b.grey.bytes[i]);
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
        sum.colour += std::abs(a.colour.bytes[c] - b.colour.bytes[c]) / 3.0;
      const float metres = a.depth.metres[i];
      sum.wrong_depth += std::abs(metres - b.depth.metres[i]) > std::max(1e-3F, 1e-3F * metres) ? 1.0 : 0.0;
    }
  }
}

void ExpectAgreement(const worlds::World& world, const std::vector<View>& views) {
  const auto gl = MakeRenderer("auto", world, Movers());
  const auto own = MakeRenderer("raster", world, Movers());
  Difference sum;
  for (const View& view : views) {
    const base::Transform ahead{base::Exp(base::Vec3(0.3, 0.2, 0.1)), {0.2, 0.05, 1.1}};
    const std::vector<base::Transform> poses = {view.X_WC * ahead, view.X_WC * ahead * ahead};
    gl->PlaceMovers(poses);
    own->PlaceMovers(poses);
    Add(See(*gl, view), See(*own, view), sum);
  }
  EXPECT_GT(sum.pixels, 0.8 * 640 * 480 * static_cast<double>(views.size()));
  EXPECT_LT(sum.grey / sum.pixels, 0.5);  // levels; rounding of texture weights to 1/256 gives about 0.15
  EXPECT_LT(sum.colour / sum.pixels, 0.5);
  EXPECT_LT(sum.wrong_depth / sum.pixels, 1e-3);
}

TEST(Raster, DrawsWhatGlDraws) {
  ExpectAgreement(worlds::MakeCourtyard({}, 5), Poses(3, 6, {12, 8, 3}));
  ExpectAgreement(test::Clutter(8, 100), Poses(4, 4, {9, 9, 3}));
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
