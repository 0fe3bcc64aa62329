#include "render/raster/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "render/raster/clipper.h"
#include "render/raster/holes.h"
#include "render/raster/morton.h"
#include "render/raster/visibility_buffer.h"

namespace alula::render::raster {
namespace {

using internal::kShadowSide;

/// Nearness to the sun, 1 − depth, as a plane over the map's texels, with its slope's share taken off.
bool NearnessPlane(const std::array<base::Vec3, 3>& p, ScreenTriangle& triangle) {
  constexpr double kSlopes = 1.5;
  const base::Vec3 a = p[1] - p[0];
  const base::Vec3 b = p[2] - p[0];
  const double area = a.x() * b.y() - a.y() * b.x();
  if (area == 0.0) return false;
  const double by_x = (a.z() * b.y() - b.z() * a.y()) / area;
  const double by_y = (b.z() * a.x() - a.z() * b.x()) / area;
  const double offset = kSlopes * std::max(std::abs(by_x), std::abs(by_y));
  triangle.plane[0] = p[0].z() - by_x * p[0].x() - by_y * p[0].y() - offset;
  triangle.plane[1] = by_x;
  triangle.plane[2] = by_y;
  const auto held = [](double nearness) { return static_cast<float>(std::clamp(nearness, 0.0, 1.0)); };
  triangle.low = held(std::min({p[0].z(), p[1].z(), p[2].z()}) - offset);
  triangle.high = held(std::max({p[0].z(), p[1].z(), p[2].z()}) - offset);
  return true;
}

/// Fan of a convex polygon, whichever way it turns.
void DrawPolygon(const Kernels& kernels, const Target& target, const std::vector<Corner>& polygon,
                 const HolePlanes* holes, ScreenTriangle& triangle) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const std::array<Corner, 3> c = {polygon[0], polygon[i - 1], polygon[i]};
    const std::int64_t area =
        std::int64_t{c[1].x - c[0].x} * (c[2].y - c[0].y) - std::int64_t{c[2].x - c[0].x} * (c[1].y - c[0].y);
    if (area == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& corner = c[area > 0 ? k : 2 - k];
      triangle.x[k] = corner.x;
      triangle.y[k] = corner.y;
    }
    holes != nullptr ? kernels.draw_with_holes(target, triangle, *holes) : kernels.draw_one(target, triangle);
  }
}

/// Draws a part into a target whose pixel (0, 0) is texel `origin` of the map.
void DrawPart(const RasterScene& scene, const RasterScene::Part& part, const internal::ShadowFrame& frame,
              const PackedTextures& alpha, const Kernels& kernels, const base::Vec2& origin, const Target& target) {
  const Vertices& v = scene.vertices();
  std::vector<Corner> polygon;
  for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangles; ++t) {
    std::array<base::Vec3, 3> p;  // texels, texels, nearness
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = scene.corners(static_cast<int>(i))[t];
      const Eigen::Vector4d at(v.x[vertex], v.y[vertex], v.z[vertex], 1.0);
      p[i] = (frame.texture_from_world * at).head<3>();
      p[i] = {p[i].x() * kShadowSide - 0.5 - origin.x(), p[i].y() * kShadowSide - 0.5 - origin.y(), 1.0 - p[i].z()};
      corners[i].column = p[i].x();
      corners[i].row = p[i].y();
      corners[i].depth = 1.0;
    }
    ScreenTriangle triangle{};
    if (!NearnessPlane(p, triangle)) continue;
    ClipTriangle(corners, 0.5, polygon);
    HolePlanes holes;
    if (part.holes) {
      std::array<base::Vec3, 3> flat;
      for (std::size_t i = 0; i < 3; ++i) flat[i] = {p[i].x(), p[i].y(), 1.0};
      holes = HolesOf(scene, alpha, t, flat, p[0].head<2>().array().round().max(0.0).min(kShadowSide));
    }
    DrawPolygon(kernels, target, polygon, part.holes ? &holes : nullptr, triangle);
  }
}

std::uint32_t DistanceAt(const Target& target, int x, int y) {
  const int tile = y / kTile * target.tiles_x + x / kTile;
  const float nearness = target.inverse_depth[tile * kTile * kTile + y % kTile * kTile + x % kTile];
  return static_cast<std::uint32_t>(std::ceil((1.0F - nearness) * 65535.0F));
}

/// 65535 on the rim: what lies beyond the map looks up its edge and finds light.
std::uint32_t TexelAt(const Target& target, int x, int y) {
  constexpr int kLast = kShadowSide - 1;
  return x == 0 || y == 0 || x >= kLast || y >= kLast ? 65535 : DistanceAt(target, x, y);
}

/// Takes what is nearer to the sun into the map; the target's pixel (0, 0) is the region's first texel.
void Merge(const Target& target, const internal::ShadowRegion& region, std::vector<std::uint32_t>& words) {
  for (int y = region.y0; y <= region.y1; ++y) {
    for (int x = region.x0; x <= region.x1; ++x) {
      const std::uint32_t distance = DistanceAt(target, x - region.x0, y - region.y0);
      std::uint32_t& here = words[Morton(x, y)];
      here = (here & 0xffff0000U) | std::min(here & 0xffffU, distance);
      std::uint32_t& above = words[Morton(x, y - 1)];
      above = (above & 0xffffU) | std::min(above >> 16, distance) << 16;
    }
  }
}

}  // namespace

ShadowMap::ShadowMap(const RasterScene& scene, const internal::ShadowFrame& frame, const PackedTextures& alpha,
                     const Kernels& kernels)
    : words_(static_cast<std::size_t>(kShadowSide) * kShadowSide) {
  VisibilityBuffer buffer;
  const Target target = buffer.Clear(kShadowSide, kShadowSide, 0.0F, false);
  for (std::size_t number = 0; number < scene.statics(); ++number) {
    DrawPart(scene, scene.parts()[number], frame, alpha, kernels, base::Vec2::Zero(), target);
  }
  for (int y = 0; y < kShadowSide; ++y) {
    for (int x = 0; x < kShadowSide; ++x) {
      words_[Morton(x, y)] = TexelAt(target, x, y) | TexelAt(target, x, y + 1) << 16;
    }
  }
  if (scene.parts().size() > scene.statics()) statics_ = words_;
}

const std::uint32_t* ShadowMap::Words(const RasterScene& scene, const internal::ShadowFrame& frame,
                                      const PackedTextures& alpha, const Kernels& kernels) {
  if (is_current_ || statics_.empty()) return words_.data();
  for (const internal::ShadowRegion& region : regions_) {
    for (int y = region.y0 - 1; y <= region.y1; ++y) {
      for (int x = region.x0; x <= region.x1; ++x) words_[Morton(x, y)] = statics_[Morton(x, y)];
    }
  }
  regions_.clear();
  for (std::size_t number = scene.statics(); number < scene.parts().size(); ++number) {
    const internal::Batch& box = scene.boxes()[number];
    const internal::ShadowRegion region = internal::RegionOf(frame.texture_from_world, box.low, box.high);
    if (region.IsEmpty()) continue;
    VisibilityBuffer buffer;
    const Target target = buffer.Clear(region.x1 - region.x0 + 1, region.y1 - region.y0 + 1, 0.0F, false);
    DrawPart(scene, scene.parts()[number], frame, alpha, kernels, {region.x0, region.y0}, target);
    Merge(target, region, words_);
    regions_.push_back(region);
  }
  is_current_ = true;
  return words_.data();
}

}  // namespace alula::render::raster
