#include "render/raster/vertex_light.h"

#include <algorithm>
#include <cmath>

namespace alula::render::raster {

VertexLight LightOf(const internal::SceneGeometry& geometry) {
  constexpr double kSide = internal::kShadowSide;
  VertexLight light;
  light.to_sun = geometry.light.to_sun_W.normalized().cast<float>();
  light.sun = geometry.light.sun;
  light.ambient = geometry.light.ambient;
  light.normal_offset = internal::kShadowNormalOffset * static_cast<float>(geometry.shadow.texel);
  Eigen::Matrix<double, 3, 4> map = geometry.shadow.texture_from_world.topRows<3>();
  map = (base::Vec3(kSide, kSide, 65535.0).asDiagonal() * map).eval();
  map.col(3) -= base::Vec3(0.5, 0.5, 0.0);
  light.map_from_world = map.cast<float>();
  return light;
}

void WriteAttributes(const VertexLight& l, const geometry::Mesh::Vertex& v, const Eigen::Vector2f& texels, float* out) {
  const float facing = v.normal.dot(l.to_sun);
  const float sky = l.ambient * (0.75F + 0.20F * v.normal.z() + 0.10F * facing);
  const float sun = l.sun * std::max(facing, 0.0F);
  const Eigen::Vector3f moved =
      v.position + v.normal * (l.normal_offset * std::sqrt(std::max(1.0F - facing * facing, 0.0F)));
  const Eigen::Vector3f shadow_at = l.map_from_world.leftCols<3>() * moved + l.map_from_world.col(3);
  out[0] = 1.0F;
  out[1] = v.uv.x() * texels.x();
  out[2] = v.uv.y() * texels.y();
  out[3] = std::sqrt(std::max(0.6F * sky, 0.0F));
  out[4] = std::sqrt(std::max(0.6F * sky + 1.4F * sun, 0.0F)) - out[3];
  for (int axis = 0; axis < 3; ++axis) out[5 + axis] = shadow_at[axis];
}

}  // namespace alula::render::raster
