#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <vector>

#include "render/internal/scene_geometry.h"
#include "render/raster/kernels.h"
#include "render/raster/packed_textures.h"
#include "render/raster/shadow_map.h"
#include "render/raster/shadowing.h"

namespace alula::render::raster {

/// All that is drawn, as the kernels want it: places by axis, attributes by vertex. Statics stand in the world, movers
/// in their own frames. Never changed once made (textures are packed when first asked for): renderers on several
/// threads share it.
class RasterScene {
 public:
  RasterScene(internal::SceneGeometry geometry, const Kernels& kernels);

  const internal::SceneGeometry& geometry() const { return geometry_; }
  std::size_t triangles() const { return texture_of_triangle_.size(); }
  std::size_t vertices() const { return geometry_.vertices.size(); }
  std::size_t mover_vertices() const { return vertices() - first_mover_vertex_; }
  std::uint32_t first_mover_vertex() const { return first_mover_vertex_; }
  /// First (0), second or third corners of all triangles.
  const std::uint32_t* corners(std::size_t i) const { return corners_[i].data(); }
  const std::uint32_t* texture_of_triangle() const { return texture_of_triangle_.data(); }
  Positions positions() const { return {positions_[0].data(), positions_[1].data(), positions_[2].data()}; }
  const float* attributes() const { return attributes_.data(); }  // of the statics
  const float* normals() const { return normals_.data(); }        // of the statics, three floats each
  const ShadowMap& shadow_map() const { return shadow_map_; }     // of the statics
  const ShadowingTable& shadowing() const { return shadowing_; }
  const PackedTextures& alpha() const { return alpha_; }
  /// Instance that a triangle belongs to: number of its object or mover + 1.
  std::uint32_t instance_of(std::uint32_t triangle) const { return instance_of_triangle_[triangle]; }
  /// Throws base::FaultError as PackTextures does.
  const PackedTextures& Textures(internal::TextureKind kind) const;

  /// Attributes and normals of the vertices of a mover's level at X_WM. `out`, `normals`: places of the first mover's
  /// first vertex.
  void LightMover(const internal::Level& level, const base::Transform& X_WM, float* out, float* normals) const;

 private:
  void SetTriangles(const internal::Batch& batch, std::uint32_t instance);
  void SetPositions();

  internal::SceneGeometry geometry_;
  std::array<std::vector<float>, 3> positions_;
  std::array<std::vector<std::uint32_t>, 3> corners_;
  std::vector<std::uint32_t> texture_of_triangle_;
  std::vector<Eigen::Vector2f> texels_;  // a period of each vertex's texture
  std::vector<std::uint32_t> instance_of_triangle_;
  std::vector<float> attributes_;
  std::vector<float> normals_;
  std::uint32_t first_mover_vertex_ = 0;
  PackedTextures alpha_;
  ShadowMap shadow_map_;
  ShadowingTable shadowing_;
  mutable std::mutex packing_;
  mutable std::array<std::optional<PackedTextures>, 4> textures_;  // by kind
};

}  // namespace alula::render::raster
