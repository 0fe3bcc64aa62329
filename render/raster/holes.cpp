#include "render/raster/holes.h"

namespace alula::render::raster {

HolePlanes HolesOf(const internal::SceneGeometry& scene, const PackedTextures& alpha, std::size_t material,
                   const std::array<std::uint32_t, 3>& vertices, const std::array<base::Vec3, 3>& corners,
                   const base::Vec2& about) {
  HolePlanes planes{};
  planes.texture = alpha.views[material];
  planes.words = alpha.words[0].data();
  const std::array<base::Vec3, 3> cross = {corners[1].cross(corners[2]), corners[2].cross(corners[0]),
                                           corners[0].cross(corners[1])};
  const double scale = 1.0 / corners[0].dot(cross[0]);
  const base::Vec2 sides(planes.texture.last_column + 1, planes.texture.last_row + 1);
  const auto uv_of = [&](std::size_t i) { return scene.vertices[vertices[i]].uv.cast<double>().eval(); };
  const base::Vec2 periods = uv_of(0).array().floor();  // taken off, so that single precision stays below a texel
  planes.reference_x = static_cast<float>(about.x());
  planes.reference_y = static_cast<float>(about.y());
  for (int k = 0; k < 3; ++k) {
    base::Vec3 plane = base::Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = k == 0 ? 1.0 : (uv_of(i)[k - 1] - periods[k - 1]) * sides[k - 1];
      plane += scale * value * cross[i];
    }
    planes.at[k] = static_cast<float>(plane.dot(base::Vec3(about.x(), about.y(), 1.0)));
    planes.by_x[k] = static_cast<float>(plane.x());
    planes.by_y[k] = static_cast<float>(plane.y());
  }
  return planes;
}

}  // namespace alula::render::raster
