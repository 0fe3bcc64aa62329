#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "render/internal/draw_list.h"
#include "render/internal/gl_program.h"
#include "render/internal/scene_geometry.h"
#include "render/internal/shadow_frame.h"
#include "render/internal/texture_levels.h"

namespace alula::render::internal {

/// The scene's buffers, textures and shadow map in one context, which must be current in every call.
class GpuScene {
 public:
  GpuScene(const GlFunctions& gl, SceneGeometry geometry, const worlds::World& world);

  const SceneGeometry& geometry() const { return geometry_; }
  /// Binds buffers and the shadow map and gives the program in use the light.
  void Bind(const GlProgram& program) const;
  /// Whether anything has holes.
  bool HasHoles() const { return has_holes_; }
  /// Draws the runs with the program in use and textures of the kind (and the holes of those that have some).
  void Draw(std::span<const DrawRun> runs, TextureKind kind);

 private:
  void Upload();
  void DrawShadowMap();
  GLuint TextureOf(int material, TextureKind kind);
  GLuint AlphaOf(int material);

  const GlFunctions* gl_;
  SceneGeometry geometry_;
  worlds::Light light_;
  ShadowFrame shadow_;
  bool has_holes_ = false;
  GLuint vertex_array_ = 0;
  GLuint shadow_map_ = 0;
  std::map<int, GLuint> alphas_;                            // of materials with holes
  std::map<std::pair<TextureKind, int>, GLuint> textures_;  // by kind and material, made when first needed
};

}  // namespace alula::render::internal
