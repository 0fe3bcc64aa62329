#include "render/raster/raster_scene.h"

#include <algorithm>

#include "render/raster/vertex_light.h"

namespace alula::render::raster {
namespace {

Eigen::Vector2f SidesOf(const geometry::Material& material) {
  if (!material.texture) return Eigen::Vector2f::Ones();
  return Eigen::Vector2i(material.texture->width, material.texture->height).cast<float>();
}

}  // namespace

RasterScene::RasterScene(internal::SceneGeometry geometry, const Kernels& kernels) : geometry_(std::move(geometry)) {
  const std::size_t triangles = geometry_.indices.size() / 3;
  texture_of_triangle_.resize(triangles);
  texels_.resize(geometry_.vertices.size());
  for (std::size_t i = 0; i < 3; ++i) {
    corners_[i].assign(triangles + kTile, 0);
    for (std::size_t t = 0; t < triangles; ++t) corners_[i][t] = geometry_.indices[3 * t + i];
  }
  instance_of_triangle_.resize(triangles);
  std::uint32_t instance = 0;
  for (const internal::Batch& batch : geometry_.statics) SetTriangles(batch, ++instance);
  for (const internal::Batch& batch : geometry_.movers) SetTriangles(batch, ++instance);
  SetPositions();
  first_mover_vertex_ = static_cast<std::uint32_t>(
      geometry_.movers.empty() ? geometry_.vertices.size() : geometry_.movers.front().levels[0].first_vertex);
  const VertexLight light = LightOf(geometry_);
  attributes_.resize(std::size_t{first_mover_vertex_} * kAttributes);
  for (std::size_t i = 0; i < first_mover_vertex_; ++i) {
    WriteAttributes(light, geometry_.vertices[i], texels_[i], attributes_.data() + i * kAttributes);
    const Eigen::Vector3f& normal = geometry_.vertices[i].normal;
    normals_.insert(normals_.end(), normal.begin(), normal.end());
  }
  alpha_ = PackAlpha(geometry_.materials);
  shadow_map_ = DrawShadowMap(geometry_, alpha_, kernels);
  shadowing_ = FindShadowing(geometry_, attributes_, shadow_map_);
}

void RasterScene::SetTriangles(const internal::Batch& batch, std::uint32_t instance) {
  const auto material = static_cast<std::uint32_t>(batch.material);
  const Eigen::Vector2f sides = SidesOf(geometry_.materials[material]);
  for (int i = 0; i < batch.level_count; ++i) {
    const internal::Level& level = batch.levels[static_cast<std::size_t>(i)];
    std::fill_n(texture_of_triangle_.begin() + level.first_index / 3, level.index_count / 3, material);
    std::fill_n(instance_of_triangle_.begin() + level.first_index / 3, level.index_count / 3, instance);
    std::fill_n(texels_.begin() + level.first_vertex, level.vertex_count, sides);
  }
}

void RasterScene::SetPositions() {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& positions = positions_[static_cast<std::size_t>(axis)];
    positions.reserve(geometry_.vertices.size());
    for (const geometry::Mesh::Vertex& v : geometry_.vertices) positions.push_back(v.position[axis]);
  }
}

const PackedTextures& RasterScene::Textures(internal::TextureKind kind) const {
  const std::lock_guard lock(packing_);
  std::optional<PackedTextures>& textures = textures_[static_cast<std::size_t>(kind)];
  if (!textures) textures = PackTextures(geometry_.materials, kind);
  return *textures;
}

void RasterScene::LightMover(const internal::Level& level, const base::Transform& X_WM, float* out,
                             float* normals) const {
  const VertexLight light = LightOf(geometry_);
  const base::Mat3 R_WM = X_WM.R();
  for (std::size_t i = level.first_vertex; i < std::size_t{level.first_vertex} + level.vertex_count; ++i) {
    geometry::Mesh::Vertex v = geometry_.vertices[i];
    v.position = (R_WM * v.position.cast<double>() + X_WM.p).cast<float>();
    v.normal = (R_WM * v.normal.cast<double>()).cast<float>();
    WriteAttributes(light, v, texels_[i], out + (i - first_mover_vertex_) * kAttributes);
    std::copy_n(v.normal.data(), 3, normals + 3 * (i - first_mover_vertex_));
  }
}

}  // namespace alula::render::raster
