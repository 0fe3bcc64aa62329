#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/camera_renderer.h"
#include "render/internal/detail_levels.h"
#include "render/internal/shadow_frame.h"

namespace alula::render::internal {

/// Vertices of a level begin at multiples of this: the rasteriser takes eight at a time.
inline constexpr std::uint32_t kVertexRun = 8;

/// A run of triangles, of the vertices they use, and how far they lie from the full level's surface.
struct Level {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  float error = 0.0F;  // m
};

/// One object: its material, its levels of detail from the full one on, and the axis-aligned box that holds them.
struct Batch {
  int material = 0;
  bool holes = false;  // its texture has some
  bool of_vehicle = false;
  bool casts_shadow = true;
  std::array<Level, kMostLevels> levels;
  int level_count = 0;
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
};

/// Everything that is drawn, in one pair of buffers. Statics are in world coordinates, movers in their own frames.
/// Never changed once built: renderers on several threads share it.
struct SceneGeometry {
  std::vector<geometry::Mesh::Vertex> vertices;
  std::vector<std::uint32_t> indices;             // three a triangle, into `vertices`
  std::vector<Batch> statics;                     // one an object of the world
  std::vector<Batch> movers;                      // one a mover, in their order
  std::vector<geometry::Material> materials;      // the world's, then the movers'
  Eigen::Vector3f low = Eigen::Vector3f::Zero();  // of all statics, m
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  std::vector<worlds::SemanticClass> classes;  // by instance
  worlds::Light light;
  ShadowFrame shadow;  // of the statics

  bool Has(worlds::SemanticClass semantic) const {
    return std::find(classes.begin(), classes.end(), semantic) != classes.end();
  }
};

/// Tessellates the world and the movers. Throws base::FaultError for an object whose material does not exist, and
/// base::InputError for light that cannot be (CheckLight).
SceneGeometry BuildScene(const worlds::World& world, std::span<const Mover> movers);

/// How far a level's surface may lie from the full level's in the picture's middle, px; 1/cos of the angle off the
/// axis more elsewhere. Depth is off by as little: kPixelError / f of itself for a surface that is seen square on.
inline constexpr double kPixelError = 0.5;

/// The coarsest level whose error is seen as less than kPixelError from `eye` (in the batch's axes, m), reckoned at the
/// nearest point of its box. `focal`: the longer focal length, px; infinity gives the full level.
const Level& LevelFor(const Batch& batch, const Eigen::Vector3f& eye, double focal);

}  // namespace alula::render::internal
