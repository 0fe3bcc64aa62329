#include "render/raster/raster_scene.h"

#include <algorithm>
#include <cmath>

namespace alula::render::raster {
namespace {

RasterScene::Part PartOf(const internal::SceneGeometry& scene, const internal::Batch& batch) {
  RasterScene::Part part;
  part.first_triangle = batch.first_index / 3;
  part.triangles = batch.index_count / 3;
  part.holes = batch.holes;
  if (part.triangles == 0) return part;
  const auto first = scene.indices.begin() + static_cast<std::ptrdiff_t>(batch.first_index);
  const auto [low, high] = std::minmax_element(first, first + static_cast<std::ptrdiff_t>(batch.index_count));
  part.first_vertex = *low;
  part.vertices = *high - *low + 1;
  return part;
}

}  // namespace

Lighting LightingOf(const worlds::Light& light, const internal::ShadowFrame& frame) {
  Lighting lighting;
  lighting.to_sun = light.to_sun_W.normalized().cast<float>();
  lighting.sun = light.sun;
  lighting.ambient = light.ambient;
  lighting.normal_offset = internal::kShadowNormalOffset * static_cast<float>(frame.texel);
  lighting.shadow_from_world = frame.texture_from_world.topRows<3>().cast<float>();
  return lighting;
}

RasterScene::RasterScene(internal::SceneGeometry geometry, const Lighting& lighting)
    : geometry_(std::move(geometry)), lighting_(lighting), boxes_(geometry_.statics) {
  boxes_.insert(boxes_.end(), geometry_.movers.begin(), geometry_.movers.end());
  const std::size_t triangles = geometry_.indices.size() / 3;
  texture_of_triangle_.resize(triangles);
  part_of_triangle_.resize(triangles);
  normals_.resize(3 * geometry_.vertices.size());
  for (std::size_t i = 0; i < 3; ++i) {
    corners_[i].assign(triangles + kTile, 0);
    for (std::size_t t = 0; t < triangles; ++t) corners_[i][t] = geometry_.indices[3 * t + i];
  }
  for (const internal::Batch& batch : boxes_) {
    const Part part = PartOf(geometry_, batch);
    const auto number = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back(part);
    std::fill_n(part_of_triangle_.begin() + static_cast<std::ptrdiff_t>(part.first_triangle), part.triangles, number);
    std::fill_n(texture_of_triangle_.begin() + static_cast<std::ptrdiff_t>(part.first_triangle), part.triangles,
                static_cast<std::uint32_t>(batch.material));
  }
  geometry_.indices = {};
  PointAtArrays();
  for (std::size_t i = 0; i < geometry_.vertices.size(); ++i) {
    Place(i, geometry_.vertices[i].position, geometry_.vertices[i].normal);
  }
}

void RasterScene::PointAtArrays() {
  // The kernels take eight at a time and may read and write past the last vertex.
  const std::size_t length = geometry_.vertices.size() + kTile;
  floats_.assign(length * (7 + kAttributes), 0.0F);
  integers_.assign(length * 3, 0);
  float* next = floats_.data();
  const auto take = [&next, length](std::size_t each) {
    float* array = next;
    next += length * each;
    return array;
  };
  for (float*& axis : positions_) axis = take(1);
  attributes_ = take(kAttributes);
  vertices_.x = positions_[0];
  vertices_.y = positions_[1];
  vertices_.z = positions_[2];
  vertices_.attributes = attributes_;
  vertices_.column = take(1);
  vertices_.row = take(1);
  vertices_.depth = take(1);
  vertices_.inverse_depth = take(1);
  vertices_.pixel_x = integers_.data();
  vertices_.pixel_y = vertices_.pixel_x + length;
  vertices_.flags = vertices_.pixel_y + length;
}

void RasterScene::Place(std::size_t vertex, const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
  const Lighting& l = lighting_;
  for (int axis = 0; axis < 3; ++axis) positions_[axis][vertex] = p[axis];
  for (int axis = 0; axis < 3; ++axis) normals_[3 * vertex + static_cast<std::size_t>(axis)] = n[axis];
  const float facing = n.dot(l.to_sun);
  const float sky = l.ambient * (0.75F + 0.20F * n.z() + 0.10F * facing);
  const float sun = l.sun * std::max(facing, 0.0F);
  const Eigen::Vector3f moved = p + n * (l.normal_offset * std::sqrt(std::max(1.0F - facing * facing, 0.0F)));
  const Eigen::Vector3f shadow_at = l.shadow_from_world.leftCols<3>() * moved + l.shadow_from_world.col(3);
  float* out = attributes_ + vertex * kAttributes;
  out[0] = 1.0F;
  out[1] = geometry_.vertices[vertex].uv.x();
  out[2] = geometry_.vertices[vertex].uv.y();
  out[3] = std::sqrt(std::max(0.6F * sky, 0.0F));
  out[4] = std::sqrt(std::max(0.6F * sky + 1.4F * sun, 0.0F));
  for (int axis = 0; axis < 3; ++axis) out[5 + axis] = shadow_at[axis];
}

void RasterScene::PlaceMover(std::size_t number, const base::Transform& X_WM) {
  const Part& part = parts_[statics() + number];
  internal::Batch& box = boxes_[statics() + number];
  const base::Mat3 R_WM = X_WM.R();
  for (std::size_t i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
    const geometry::Mesh::Vertex& v = geometry_.vertices[i];
    const Eigen::Vector3f p = (R_WM * v.position.cast<double>() + X_WM.p).cast<float>();
    Place(i, p, (R_WM * v.normal.cast<double>()).cast<float>());
    box.low = i == part.first_vertex ? p : box.low.cwiseMin(p).eval();
    box.high = i == part.first_vertex ? p : box.high.cwiseMax(p).eval();
  }
}

}  // namespace alula::render::raster
