#include "render/raster/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "render/raster/clipper.h"
#include "render/raster/holes.h"
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

/// Draws the full level of a batch into a target whose pixel (0, 0) is texel `origin` of the map.
void DrawBatch(const internal::SceneGeometry& scene, const internal::Batch& batch,
               const Eigen::Matrix4d& texture_from_batch, const PackedTextures& alpha, const Kernels& kernels,
               const base::Vec2& origin, const Target& target) {
  const internal::Level& full = batch.levels[0];
  std::vector<base::Vec3> places;  // of its vertices: texels, texels, nearness
  for (std::size_t i = 0; i < full.vertex_count; ++i) {
    const base::Vec3 v = scene.vertices[full.first_vertex + i].position.cast<double>();
    const base::Vec3 p = texture_from_batch.topLeftCorner<3, 3>() * v + texture_from_batch.topRightCorner<3, 1>();
    places.emplace_back(p.x() * kShadowSide - 0.5 - origin.x(), p.y() * kShadowSide - 0.5 - origin.y(), 1.0 - p.z());
  }
  std::vector<Corner> polygon;
  for (std::size_t index = full.first_index; index < std::size_t{full.first_index} + full.index_count; index += 3) {
    std::array<base::Vec3, 3> p;
    std::array<base::Vec3, 3> flat;
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = places[scene.indices[index + i] - full.first_vertex];
      flat[i] = {p[i].x(), p[i].y(), 1.0};
      corners[i].column = p[i].x();
      corners[i].row = p[i].y();
      corners[i].depth = 1.0;
    }
    ScreenTriangle triangle{};
    if (!NearnessPlane(p, triangle)) continue;
    ClipTriangle(corners, 0.5, polygon);
    HolePlanes holes;
    if (batch.holes) {
      const base::Vec2 about = p[0].head<2>().array().round().max(0.0).min(kShadowSide);
      holes = HolesOf(scene, alpha, static_cast<std::size_t>(batch.material),
                      {scene.indices[index], scene.indices[index + 1], scene.indices[index + 2]}, flat, about);
    }
    DrawPolygon(kernels, target, polygon, batch.holes ? &holes : nullptr, triangle);
  }
}

/// Nearness in the map's words. Rounded away from the sun: the part of a step that is cut off goes to the light.
std::int16_t DistanceOf(float nearness) {
  return static_cast<std::int16_t>(65535 - static_cast<std::int32_t>(nearness * 65535.0F) - 32768);
}

/// The rows of one row of tiles, from nearness; the map's rim stays at 65535: what lies beyond the map looks up its
/// edge and finds light.
void CopyTiles(const Target& target, int tile_row, ShadowMap& map) {
  for (int y = 0; y < kTile; ++y) {
    for (int tile = 0; tile < target.tiles_x; ++tile) {
      const float* row = target.inverse_depth + (std::ptrdiff_t{tile_row} * target.tiles_x + tile) * kTile * kTile +
                         std::ptrdiff_t{y} * kTile;
      for (int x = 0; x < kTile; ++x) {
        map.Set(tile * kTile + x, tile_row * kTile + y, DistanceOf(row[x]));
      }
    }
  }
}

void ClearRim(ShadowMap& map) {
  constexpr std::int16_t kNothing = 65535 - 32768;
  constexpr int kLast = kShadowSide - 1;
  for (int i = 0; i < kShadowSide; ++i) {
    map.Set(i, 0, kNothing);
    map.Set(i, kLast, kNothing);
    map.Set(0, i, kNothing);
    map.Set(kLast, i, kNothing);
  }
}

/// Takes what is nearer to the sun into the map; the target's pixel (0, 0) is the region's first texel.
void Merge(const Target& target, const internal::ShadowRegion& region, ShadowMap& map) {
  for (int y = region.y0; y <= region.y1; ++y) {
    const int ty = y - region.y0;
    for (int x = region.x0; x <= region.x1; ++x) {
      const int tx = x - region.x0;
      const int tile = ty / kTile * target.tiles_x + tx / kTile;
      const float nearness = target.inverse_depth[tile * kTile * kTile + ty % kTile * kTile + tx % kTile];
      const std::int16_t distance = DistanceOf(nearness);
      if (distance < map.At(x, y)) map.Set(x, y, distance);
    }
  }
}

}  // namespace

void ShadowMap::Set(int x, int y, std::int16_t distance) {
  const auto bits = std::uint32_t{static_cast<std::uint16_t>(distance)};
  std::uint32_t& own = words[Index(x, y)];
  own = (own & 0xffff0000U) | bits;
  if (y == 0) return;
  std::uint32_t& above = words[Index(x, y - 1)];
  above = (above & 0xffffU) | bits << 16;
}

ShadowMap DrawShadowMap(const internal::SceneGeometry& scene, const PackedTextures& alpha, const Kernels& kernels) {
  VisibilityBuffer buffer;
  const Target target = buffer.Clear(kShadowSide, kShadowSide, 0.0F, false);
  for (const internal::Batch& batch : scene.statics) {
    if (!batch.casts_shadow) continue;
    DrawBatch(scene, batch, scene.shadow.texture_from_world, alpha, kernels, base::Vec2::Zero(), target);
  }
  ShadowMap map;
  constexpr int kPadding = 16;  // words: rows that follow each other do not fall into the same cache sets
  map.pitch = kShadowSide + kPadding;
  map.words.resize(static_cast<std::size_t>(map.pitch) * kShadowSide);
  for (int row = 0; row < target.tiles_y; ++row) CopyTiles(target, row, map);
  ClearRim(map);
  return map;
}

const ShadowMap& MoverShadows::Place(const internal::SceneGeometry& scene, const ShadowMap& statics,
                                     const PackedTextures& alpha, const Kernels& kernels,
                                     std::span<const base::Transform> X_WM) {
  if (map_.words.empty()) map_ = statics;
  for (const internal::ShadowRegion& region : regions_) {
    for (int y = region.y0 - 1; y <= region.y1; ++y) {  // the row above holds the first row in its high halves
      const std::ptrdiff_t at = std::ptrdiff_t{y} * map_.pitch + region.x0;
      std::copy_n(statics.words.begin() + at, region.x1 - region.x0 + 1, map_.words.begin() + at);
    }
  }
  regions_.clear();
  for (std::size_t i = 0; i < X_WM.size(); ++i) {
    const internal::Batch& mover = scene.movers[i];
    if (!mover.casts_shadow) continue;
    Eigen::Matrix4d texture_from_mover = Eigen::Matrix4d::Identity();
    texture_from_mover.topLeftCorner<3, 3>() = X_WM[i].R();
    texture_from_mover.topRightCorner<3, 1>() = X_WM[i].p;
    texture_from_mover = (scene.shadow.texture_from_world * texture_from_mover).eval();
    const internal::ShadowRegion region = internal::RegionOf(texture_from_mover, mover.low, mover.high);
    if (region.IsEmpty()) continue;
    const Target target = buffer_.Clear(region.x1 - region.x0 + 1, region.y1 - region.y0 + 1, 0.0F, false);
    DrawBatch(scene, mover, texture_from_mover, alpha, kernels, {region.x0, region.y0}, target);
    Merge(target, region, map_);
    regions_.push_back(region);
  }
  return map_;
}

}  // namespace alula::render::raster
