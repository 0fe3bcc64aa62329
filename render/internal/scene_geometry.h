#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera_renderer.h"

namespace alula::render::internal {

/// A run of triangles of one material, and the axis-aligned box that holds them.
struct Batch {
  int material = 0;
  bool holes = false;  // its texture has some
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
};

/// Everything that is drawn, in one pair of buffers. Statics are in world coordinates, movers in their own frames.
struct SceneGeometry {
  std::vector<geometry::Mesh::Vertex> vertices;
  std::vector<std::uint32_t> indices;             // three a triangle, into `vertices`
  std::vector<Batch> statics;                     // one an object of the world
  std::vector<Batch> movers;                      // one a mover, in their order
  std::vector<geometry::Material> materials;      // the world's, then one a mover
  Eigen::Vector3f low = Eigen::Vector3f::Zero();  // of all statics, m
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
};

/// Tessellates the world and the movers. Throws base::FaultError for an object whose material does not exist.
SceneGeometry BuildScene(const worlds::World& world, std::span<const Mover> movers);

}  // namespace alula::render::internal
