#include "render/raster/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "render/raster/clipper.h"
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
                 ScreenTriangle& triangle) {
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
    kernels.draw_one(target, triangle);
  }
}

/// Places of all vertices in the map: texels, texels, nearness.
std::vector<base::Vec3> PlacesInMap(const internal::SceneGeometry& scene) {
  std::vector<base::Vec3> places;
  places.reserve(scene.vertices.size());
  const Eigen::Matrix4d& m = scene.shadow.texture_from_world;
  for (const geometry::Mesh::Vertex& v : scene.vertices) {
    const base::Vec3 p = m.topLeftCorner<3, 3>() * v.position.cast<double>() + m.topRightCorner<3, 1>();
    places.emplace_back(p.x() * kShadowSide - 0.5, p.y() * kShadowSide - 0.5, 1.0 - p.z());
  }
  return places;
}

/// The rows of one row of tiles, from nearness; the map's rim stays at 65535: what lies beyond the map looks up its
/// edge and finds light.
void CopyTiles(const Target& target, int tile_row, ShadowMap& map) {
  for (int y = 0; y < kTile; ++y) {
    std::uint16_t* out = map.words.data() + std::ptrdiff_t{tile_row * kTile + y} * map.pitch;
    for (int tile = 0; tile < target.tiles_x; ++tile) {
      const float* row = target.inverse_depth + (std::ptrdiff_t{tile_row} * target.tiles_x + tile) * kTile * kTile +
                         std::ptrdiff_t{y} * kTile;
      for (int x = 0; x < kTile; ++x) {
        // Rounded away from the sun: the part of a step that is cut off goes to the light.
        const std::int32_t nearness = static_cast<std::int32_t>(row[x] * 65535.0F);
        out[tile * kTile + x] = static_cast<std::uint16_t>(65535 - nearness - 32768);
      }
    }
  }
}

void ClearRim(ShadowMap& map) {
  constexpr std::uint16_t kNothing = 65535 - 32768;
  for (int i = 0; i < kShadowSide; ++i) {
    const std::ptrdiff_t last = kShadowSide - 1;
    for (const std::ptrdiff_t at : {std::ptrdiff_t{i}, last * map.pitch + i, std::ptrdiff_t{i} * map.pitch,
                                    std::ptrdiff_t{i} * map.pitch + last}) {
      map.words[static_cast<std::size_t>(at)] = kNothing;
    }
  }
}

}  // namespace

ShadowMap DrawShadowMap(const internal::SceneGeometry& scene, const Kernels& kernels) {
  VisibilityBuffer buffer;
  const Target target = buffer.Clear(kShadowSide, kShadowSide, 0.0F, false);
  const std::vector<base::Vec3> places = PlacesInMap(scene);
  std::vector<Corner> polygon;
  for (const internal::Batch& batch : scene.statics) {
    const internal::Level& full = batch.levels[0];
    for (std::size_t index = full.first_index; index < std::size_t{full.first_index} + full.index_count; index += 3) {
      std::array<base::Vec3, 3> p;
      std::array<Corner, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = places[scene.indices[index + i]];
        corners[i].column = p[i].x();
        corners[i].row = p[i].y();
        corners[i].depth = 1.0;
      }
      ScreenTriangle triangle{};
      if (!NearnessPlane(p, triangle)) continue;
      ClipTriangle(corners, 0.5, polygon);
      DrawPolygon(kernels, target, polygon, triangle);
    }
  }
  ShadowMap map;
  constexpr int kPadding = 32;  // words: rows that follow each other do not fall into the same cache sets
  map.pitch = kShadowSide + kPadding;
  map.words.resize(static_cast<std::size_t>(map.pitch) * kShadowSide);
  for (int row = 0; row < target.tiles_y; ++row) CopyTiles(target, row, map);
  ClearRim(map);
  return map;
}

}  // namespace alula::render::raster
