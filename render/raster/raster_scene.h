#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/internal/scene_geometry.h"
#include "render/internal/shadow_frame.h"
#include "render/raster/kernels.h"

namespace alula::render::raster {

/// Light and shadow look-up of a vertex (m, world axes): the law of render/internal/shaders.h.
struct Lighting {
  Eigen::Vector3f to_sun;
  float sun = 0.0F;
  float ambient = 0.0F;
  float normal_offset = 0.0F;  // m, for the shadow look-up
  Eigen::Matrix<float, 3, 4> shadow_from_world;
};
Lighting LightingOf(const worlds::Light& light, const internal::ShadowFrame& frame);

/// All that is drawn, as the kernels want it: world coordinates by axis, attributes by vertex. Movers stand where they
/// were placed last.
class RasterScene {
 public:
  RasterScene(internal::SceneGeometry geometry, const Lighting& lighting);

  /// A run of triangles and of the vertices they use.
  struct Part {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangles = 0;
    std::uint32_t first_vertex = 0;
    std::uint32_t vertices = 0;
    bool holes = false;
  };

  void PlaceMover(std::size_t number, const base::Transform& X_WM);

  const std::vector<geometry::Material>& materials() const { return geometry_.materials; }
  /// Boxes in the world and parts of the statics, then of the movers.
  const std::vector<internal::Batch>& boxes() const { return boxes_; }
  const std::vector<Part>& parts() const { return parts_; }
  std::size_t statics() const { return geometry_.statics.size(); }
  std::size_t triangles() const { return texture_of_triangle_.size(); }
  /// First (0), second or third corners of all triangles.
  const std::uint32_t* corners(int i) const { return corners_[static_cast<std::size_t>(i)].data(); }
  const std::vector<std::uint32_t>& texture_of_triangle() const { return texture_of_triangle_; }
  /// Number of the part that a triangle belongs to.
  std::uint32_t part_of(std::uint32_t triangle) const { return part_of_triangle_[triangle]; }
  /// Of all vertices, world axes, three floats each.
  const float* normals() const { return normals_.data(); }
  /// The view's arrays are shared by all views: each transforms anew what it draws.
  const Vertices& vertices() const { return vertices_; }

 private:
  void Place(std::size_t vertex, const Eigen::Vector3f& position, const Eigen::Vector3f& normal);
  void PointAtArrays();

  internal::SceneGeometry geometry_;
  Lighting lighting_;
  std::vector<internal::Batch> boxes_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> texture_of_triangle_;
  std::vector<std::uint32_t> part_of_triangle_;
  std::vector<float> normals_;
  std::array<std::vector<std::uint32_t>, 3> corners_;
  std::vector<float> floats_;  // x, y, z, attributes, column, row, depth, inverse depth, one after another
  std::vector<std::int32_t> integers_;
  Vertices vertices_{};
  float* positions_[3] = {};
  float* attributes_ = nullptr;
};

}  // namespace alula::render::raster
