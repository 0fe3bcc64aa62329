#pragma once

#include "geometry/mesh.h"
#include "render/internal/scene_geometry.h"

namespace alula::render::raster {

/// Light and shadow look-up of a vertex: the law of render/internal/shaders.h.
struct VertexLight {
  Eigen::Vector3f to_sun;
  float sun = 0.0F;
  float ambient = 0.0F;
  float normal_offset = 0.0F;                 // m, for the shadow look-up
  Eigen::Matrix<float, 3, 4> map_from_world;  // texels from the first one's centre, twice; 1/65535 of the map's depth
};
VertexLight LightOf(const internal::SceneGeometry& geometry);

/// Writes the attributes (kernels.h) of a vertex in world axes. `texels`: a period of its texture.
void WriteAttributes(const VertexLight& light, const geometry::Mesh::Vertex& v_W, const Eigen::Vector2f& texels,
                     float* out);

}  // namespace alula::render::raster
