#include "render/internal/scene_geometry.h"

#include "base/error.h"

namespace alula::render::internal {
namespace {

Batch Append(SceneGeometry& scene, const geometry::Mesh& mesh, const base::Transform& X_WO, int material) {
  const auto base_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  Batch batch;
  batch.material = material;
  batch.first_index = static_cast<std::uint32_t>(scene.indices.size());
  batch.index_count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  const base::Mat3 R_WO = X_WO.R();
  for (const geometry::Mesh::Vertex& v : mesh.vertices) {
    geometry::Mesh::Vertex placed = v;
    placed.position = (R_WO * v.position.cast<double>() + X_WO.p).cast<float>();
    placed.normal = (R_WO * v.normal.cast<double>()).cast<float>();
    const bool first = scene.vertices.size() == base_vertex;
    batch.low = first ? placed.position : batch.low.cwiseMin(placed.position).eval();
    batch.high = first ? placed.position : batch.high.cwiseMax(placed.position).eval();
    scene.vertices.push_back(placed);
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) scene.indices.push_back(base_vertex + corner);
  }
  return batch;
}

}  // namespace

SceneGeometry BuildScene(const worlds::World& world, std::span<const Mover> movers) {
  SceneGeometry scene;
  scene.materials = world.materials;
  for (const worlds::Object& object : world.objects) {
    if (object.material < 0 || static_cast<std::size_t>(object.material) >= world.materials.size()) {
      throw base::FaultError("render", "object \"" + object.name + "\" has material " +
                                           std::to_string(object.material) + " of " +
                                           std::to_string(world.materials.size()));
    }
    const geometry::Mesh mesh = geometry::Tessellate(object.shape, object.texture_scale);
    Batch batch = Append(scene, mesh, object.X_WO, object.material);
    batch.holes = geometry::HasHoles(world.materials[static_cast<std::size_t>(object.material)]);
    scene.low = scene.statics.empty() ? batch.low : scene.low.cwiseMin(batch.low).eval();
    scene.high = scene.statics.empty() ? batch.high : scene.high.cwiseMax(batch.high).eval();
    scene.statics.push_back(batch);
  }
  for (const Mover& mover : movers) {
    const int material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(mover.material);
    scene.movers.push_back(Append(scene, geometry::Tessellate(mover.shape), base::Transform{}, material));
    scene.movers.back().holes = geometry::HasHoles(mover.material);
  }
  return scene;
}

}  // namespace alula::render::internal
