// The edge functions beside a point-in-triangle test in whole numbers, pixel by pixel.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/random.h"
#include "render/raster/clipper.h"
#include "render/raster/visibility_buffer.h"

namespace alula::render::raster {
namespace {

constexpr int kWidth = 77;
constexpr int kHeight = 51;
constexpr std::int64_t kSubPixels = 1 << kSubPixelBits;

struct Point {
  std::int32_t x, y;
};
using Triangle = std::array<Point, 3>;

/// Whether the centre of pixel (u, v) belongs to a triangle, by the top-left rule as it is written down: strictly
/// inside, or on an edge that is a left one (interior to its right) or a horizontal one with the interior below.
bool Contains(const Triangle& t, int u, int v) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& a = t[i];
    const Point& b = t[(i + 1) % 3];
    const std::int64_t dx = b.x - a.x;
    const std::int64_t dy = b.y - a.y;
    const std::int64_t side = dx * (v * kSubPixels - a.y) - dy * (u * kSubPixels - a.x);
    const bool owns_its_points = dy < 0 || (dy == 0 && dx > 0);
    if (side < 0 || (side == 0 && !owns_its_points)) return false;
  }
  return true;
}

std::int64_t Area(const Triangle& t) {
  return std::int64_t{t[1].x - t[0].x} * (t[2].y - t[0].y) - std::int64_t{t[2].x - t[0].x} * (t[1].y - t[0].y);
}

ScreenTriangle OnScreen(const Triangle& t, std::uint32_t id, float inverse_depth) {
  ScreenTriangle s{};
  for (std::size_t i = 0; i < 3; ++i) {
    s.x[i] = t[i].x;
    s.y[i] = t[i].y;
  }
  s.plane[0] = inverse_depth;
  s.low = s.high = inverse_depth;
  s.id = id;
  return s;
}

std::uint32_t IdAt(const Target& target, int u, int v) {
  return target.ids[((v / kTile) * target.tiles_x + u / kTile) * kTile * kTile + (v % kTile) * kTile + u % kTile];
}

std::vector<const Kernels*> AllKernels() {
  std::vector<const Kernels*> kernels = {&ScalarKernels()};
  if (Avx2KernelsOrNull() != nullptr) kernels.push_back(Avx2KernelsOrNull());
  return kernels;
}

/// Corners on whole and half pixels are as likely as any others, so that edges run through pixel centres.
Point RandomPoint(base::RandomStream& random, double reach) {
  const auto at = [&](int side) {
    const auto sub_pixel = static_cast<std::int32_t>(random.Uniform(-reach, side + reach) * kSubPixels);
    return random.Index(2) == 0 ? sub_pixel : sub_pixel & ~127;
  };
  const std::int32_t x = at(kWidth);
  return {x, at(kHeight)};
}

TEST(RasterEdges, CoverWhatAPointInTriangleTestCovers) {
  for (const Kernels* kernels : AllKernels()) {
    base::RandomStream random(1, "edges");
    VisibilityBuffer buffer;
    for (int trial = 0; trial < 400; ++trial) {
      // From a few pixels to the whole guard band: edge functions far beyond 32 bits.
      const double reach = trial % 4 == 3 ? 8000.0 : trial % 4 == 2 ? 200.0 : -10.0;
      Triangle t = {RandomPoint(random, reach), RandomPoint(random, reach), RandomPoint(random, reach)};
      if (Area(t) < 0) std::swap(t[1], t[2]);
      const Target target = buffer.Clear(kWidth, kHeight, 0.0F, true);
      kernels->draw_one(target, OnScreen(t, 7, 1.0F));
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < kWidth; ++u) {
          ASSERT_EQ(IdAt(target, u, v) == 7, Area(t) > 0 && Contains(t, u, v)) << kernels->name << " " << trial;
        }
      }
    }
  }
}

// A fan about a point: every pixel of the polygon is drawn by exactly one of its triangles.
TEST(RasterEdges, SharedEdgesAreDrawnOnce) {
  for (const Kernels* kernels : AllKernels()) {
    base::RandomStream random(2, "fan");
    VisibilityBuffer buffer;
    for (int trial = 0; trial < 100; ++trial) {
      const std::array<Point, 4> rim = {
          Point{-20 * 256, -20 * 256}, {120 * 256, -20 * 256}, {120 * 256, 90 * 256}, {-20 * 256, 90 * 256}};
      const Point middle = RandomPoint(random, 0.0);
      std::vector<int> times(static_cast<std::size_t>(kWidth * kHeight), 0);
      for (std::size_t i = 0; i < 4; ++i) {
        const Target target = buffer.Clear(kWidth, kHeight, 0.0F, true);
        kernels->draw_one(target, OnScreen({middle, rim[i], rim[(i + 1) % 4]}, 1, 1.0F));
        for (int p = 0; p < kWidth * kHeight; ++p) {
          times[static_cast<std::size_t>(p)] += IdAt(target, p % kWidth, p / kWidth) == 1 ? 1 : 0;
        }
      }
      for (const int count : times) ASSERT_EQ(count, 1) << kernels->name << " " << trial;
    }
  }
}

// Many triangles in any order: the nearest is seen, whatever the tiles' bounds leave out.
TEST(RasterEdges, TileBoundsNeverHideWhatIsNearer) {
  for (const Kernels* kernels : AllKernels()) {
    base::RandomStream random(3, "order");
    VisibilityBuffer buffer;
    const Target target = buffer.Clear(kWidth, kHeight, 0.0F, true);
    std::vector<std::pair<Triangle, float>> drawn;
    for (std::uint32_t i = 0; i < 300; ++i) {
      Triangle t = {RandomPoint(random, 30.0), RandomPoint(random, 30.0), RandomPoint(random, 30.0)};
      if (Area(t) < 0) std::swap(t[1], t[2]);
      drawn.emplace_back(t, static_cast<float>(random.Uniform(0.1, 1.0)));
      kernels->draw_one(target, OnScreen(t, i + 1, drawn.back().second));
    }
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        std::uint32_t expected = 0;
        float nearest = 0.0F;
        for (std::uint32_t i = 0; i < drawn.size(); ++i) {
          const auto& [t, depth] = drawn[i];
          if (depth < nearest || Area(t) <= 0 || !Contains(t, u, v)) continue;
          nearest = depth;
          expected = i + 1;
        }
        ASSERT_EQ(IdAt(target, u, v), expected) << kernels->name << " " << u << " " << v;
      }
    }
  }
}

TEST(RasterEdges, ClippedTrianglesMeetAtTheSamePoints) {
  base::RandomStream random(4, "clip");
  std::vector<Corner> left;
  std::vector<Corner> right;
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Corner, 4> c;
    for (Corner& corner : c) {
      corner.depth = random.Uniform(-2.0, 3.0);
      corner.column = random.Uniform(-300.0, 300.0);  // inside the guard band at the near plane
      corner.row = random.Uniform(-300.0, 300.0);
    }
    ClipTriangle({c[0], c[1], c[2]}, 0.05, left);
    ClipTriangle({c[2], c[1], c[3]}, 0.05, right);
    // The common edge, walked both ways, is cut where it meets the near plane: one point or none, in both polygons.
    if ((c[1].depth < 0.05) == (c[2].depth < 0.05)) continue;
    int common = 0;
    for (const Corner& a : left) {
      for (const Corner& b : right) {
        common += std::abs(a.depth - 0.05) < 1e-12 && a.column == b.column && a.row == b.row && a.x == b.x ? 1 : 0;
      }
    }
    EXPECT_EQ(common, 1);
  }
}

}  // namespace
}  // namespace alula::render::raster
