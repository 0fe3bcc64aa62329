#include "render/internal/scene_geometry.h"

#include <algorithm>

#include "base/error.h"
#include "render/internal/air_and_lamps.h"
#include "render/internal/surface_classes.h"

namespace alula::render::internal {
namespace {

/// Vertices and triangles of a level; the batch's box grows about them.
Level AppendLevel(SceneGeometry& scene, const DetailLevel& detail, const base::Transform& X_WO, Batch& batch) {
  Level level;
  level.first_index = static_cast<std::uint32_t>(scene.indices.size());
  level.index_count = static_cast<std::uint32_t>(3 * detail.mesh.triangles.size());
  level.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  level.vertex_count = static_cast<std::uint32_t>(detail.mesh.vertices.size());
  level.error = static_cast<float>(detail.error);
  const base::Mat3 R_WO = X_WO.R();
  bool first = batch.level_count == 0;
  for (const geometry::Mesh::Vertex& v : detail.mesh.vertices) {
    geometry::Mesh::Vertex placed = v;
    placed.position = (R_WO * v.position.cast<double>() + X_WO.p).cast<float>();
    placed.normal = (R_WO * v.normal.cast<double>()).cast<float>();
    batch.low = first ? placed.position : batch.low.cwiseMin(placed.position).eval();
    batch.high = first ? placed.position : batch.high.cwiseMax(placed.position).eval();
    first = false;
    scene.vertices.push_back(placed);
  }
  if (!scene.vertices.empty()) {
    const std::size_t eights = (scene.vertices.size() + kVertexRun - 1) / kVertexRun;
    scene.vertices.resize(eights * kVertexRun, scene.vertices.back());
  }
  for (const auto& triangle : detail.mesh.triangles) {
    for (const std::uint32_t corner : triangle) scene.indices.push_back(level.first_vertex + corner);
  }
  return level;
}

Batch Append(SceneGeometry& scene, const std::vector<DetailLevel>& levels, const base::Transform& X_WO, int material) {
  Batch batch;
  batch.material = material;
  batch.holes = geometry::HasHoles(scene.materials[static_cast<std::size_t>(material)]);
  for (const DetailLevel& detail : levels) {
    const Level level = AppendLevel(scene, detail, X_WO, batch);
    batch.levels[static_cast<std::size_t>(batch.level_count++)] = level;
  }
  return batch;
}

/// Index of a mover's material among those of the movers before it (from `first` on); added where none is alike.
int MaterialOf(SceneGeometry& scene, std::size_t first, const geometry::Material& wanted) {
  for (std::size_t i = first; i < scene.materials.size(); ++i) {
    const geometry::Material& m = scene.materials[i];
    if (m.texture == wanted.texture && m.colour == wanted.colour && m.infrared == wanted.infrared) {
      return static_cast<int>(i);
    }
  }
  scene.materials.push_back(wanted);
  return static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace

SceneGeometry BuildScene(const worlds::World& world, std::span<const Mover> movers) {
  CheckLight(world.light);
  SceneGeometry scene;
  scene.materials = world.materials;
  for (const worlds::Object& object : world.objects) {
    if (object.material < 0 || static_cast<std::size_t>(object.material) >= world.materials.size()) {
      throw base::FaultError("render", "object \"" + object.name + "\" has material " +
                                           std::to_string(object.material) + " of " +
                                           std::to_string(world.materials.size()));
    }
    Batch batch = Append(scene, DetailLevels(object.shape, object.texture_scale, object.wire_radius), object.X_WO,
                         object.material);
    batch.casts_shadow = object.casts_shadow;
    scene.low = scene.statics.empty() ? batch.low : scene.low.cwiseMin(batch.low).eval();
    scene.high = scene.statics.empty() ? batch.high : scene.high.cwiseMax(batch.high).eval();
    scene.statics.push_back(batch);
  }
  for (const Mover& mover : movers) {
    const int material = MaterialOf(scene, world.materials.size(), mover.material);
    scene.movers.push_back(Append(scene, DetailLevels(mover.shape, mover.texture_scale), base::Transform{}, material));
    scene.movers.back().of_vehicle = mover.of_vehicle;
    scene.movers.back().casts_shadow = mover.casts_shadow;
  }
  scene.classes = ClassesOf(world, movers);
  scene.light = world.light;
  scene.shadow = FrameShadow(world, scene.low, scene.high);
  return scene;
}

const Level& LevelFor(const Batch& batch, const Eigen::Vector3f& eye, double focal) {
  const Eigen::Vector3f nearest = eye.cwiseMax(batch.low).cwiseMin(batch.high);
  const double allowed = kPixelError * static_cast<double>((eye - nearest).norm()) / focal;
  std::size_t level = static_cast<std::size_t>(std::max(batch.level_count, 1)) - 1;
  while (level > 0 && static_cast<double>(batch.levels[level].error) > allowed) --level;
  return batch.levels[level];
}

}  // namespace alula::render::internal
