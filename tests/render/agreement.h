#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "render/raster/raster_renderer.h"
#include "tests/render/test_scene.h"

// How makers are compared: our own rasteriser beside its scalar twin (to the bit) and beside GL (to rounding), and the
// two ways to Mesa (to the bit).

namespace alula::render::test {

/// A view, and where the movers are meanwhile.
struct Shot {
  View view;
  std::vector<base::Transform> X_WM;
};

/// Random views within ±reach.
inline std::vector<Shot> ShotsAbout(std::uint64_t seed, int count, const base::Vec3& reach) {
  base::RandomStream random(seed, "poses");
  std::vector<Shot> shots;
  for (int i = 0; i < count; ++i) {
    const base::Vec3 low(-reach.x(), -reach.y(), 0.4);
    const base::Vec3 eye = RandomPose(random, low, reach).p;
    const base::Vec3 target = RandomPose(random, 1.5 * low, 1.5 * reach).p;
    shots.push_back({LookAt(eye, target, random.Uniform(-0.4, 0.4)), {}});
  }
  return shots;
}

struct Seen {
  Picture grey, colour;
  DepthPicture depth;
  SurfacePicture surface;
};

inline Seen See(CameraRenderer& renderer, const Shot& shot) {
  Seen seen;
  renderer.PlaceMovers(shot.X_WM);
  renderer.Grey(shot.view, seen.grey);
  renderer.Colour(shot.view, seen.colour);
  renderer.Depth(shot.view, seen.depth);
  renderer.Surface(shot.view, seen.surface);
  return seen;
}

inline void ExpectSame(const Seen& a, const Seen& b) {
  EXPECT_TRUE(a.grey.bytes == b.grey.bytes);
  EXPECT_TRUE(a.colour.bytes == b.colour.bytes);
  EXPECT_TRUE(a.depth.metres == b.depth.metres);
  EXPECT_TRUE(a.surface.instances == b.surface.instances);
  EXPECT_TRUE(a.surface.normals == b.surface.normals);
}

inline void ExpectTwins(const worlds::World& world, const std::vector<Mover>& movers, std::vector<Shot> shots) {
  const raster::Kernels* avx2 = raster::Avx2KernelsOrNull();
  if (avx2 == nullptr) GTEST_SKIP() << "this processor has no AVX2";
  raster::RasterRenderer fast(*avx2, world, movers);
  raster::RasterRenderer twin(raster::ScalarKernels(), world, movers);
  EXPECT_EQ(fast.Description(), "raster avx2");
  EXPECT_EQ(twin.Description(), "raster scalar");
  shots.front().view.intrinsics.width = 333;  // no multiple of a tile
  shots.front().view.intrinsics.height = 101;
  for (const Shot& shot : shots) ExpectSame(See(fast, shot), See(twin, shot));
}

/// The two ways to Mesa, where both are installed and both run on the processor.
inline void ExpectOsMesaIsEgl(const worlds::World& world, const std::vector<Mover>& movers,
                              const std::vector<Shot>& shots) {
  std::unique_ptr<CameraRenderer> osmesa;
  std::unique_ptr<CameraRenderer> egl;
  try {
    osmesa = MakeRenderer("osmesa", world, movers);
    egl = MakeRenderer("egl", world, movers);
  } catch (const base::InputError& error) {
    GTEST_SKIP() << error.what();
  }
  if (egl->Description().find("llvmpipe") == std::string::npos) GTEST_SKIP() << egl->Description();
  for (const Shot& shot : shots) ExpectSame(See(*osmesa, shot), See(*egl, shot));
}

/// How two makers differ where no silhouette is near: depth steps of less than 2 % among the 3×3 neighbours.
struct Difference {
  double all = 0.0;     // pixels
  double pixels = 0.0;  // compared
  double grey = 0.0;    // sums of absolute differences, levels
  double colour = 0.0;
  double wrong_depth = 0.0;  // pixels that differ by more than 1 mm and 0.1 %
};

inline bool IsSilhouette(const DepthPicture& depth, int u, int v) {
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

inline void Add(const Seen& a, const Seen& b, Difference& sum) {
  for (int v = 1; v + 1 < a.depth.height; ++v) {
    for (int u = 1; u + 1 < a.depth.width; ++u) {
      sum.all += 1.0;
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

/// `levels`: mean difference that is allowed, grey levels; rounding of texture weights to 1/256 gives about 0.15.
/// `compared`: share of the pixels that must be away from silhouettes.
inline Difference ExpectAgreement(const worlds::World& world, const std::vector<Mover>& movers,
                                  const std::vector<Shot>& shots, double levels, double compared = 0.8) {
  const auto gl = MakeRenderer("osmesa", world, movers);
  const auto own = MakeRenderer("raster", world, movers);
  Difference sum;
  for (const Shot& shot : shots) Add(See(*gl, shot), See(*own, shot), sum);
  EXPECT_GT(sum.pixels, compared * sum.all);
  EXPECT_LT(sum.grey / sum.pixels, levels);
  EXPECT_LT(sum.colour / sum.pixels, levels);
  EXPECT_LT(sum.wrong_depth / sum.pixels, 1e-3);
  return sum;
}

}  // namespace alula::render::test
