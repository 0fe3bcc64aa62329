#pragma once

#include <span>
#include <vector>

#include "render/internal/draw_list.h"
#include "render/internal/gl_program.h"
#include "render/internal/scene_geometry.h"

namespace alula::render::internal {

/// The scene's buffers, textures and shadow map in one context, which must be current in every call.
class GpuScene {
 public:
  GpuScene(const GlFunctions& gl, const SceneGeometry& geometry);

  /// Binds buffers and the shadow map and gives the program in use the light.
  void Bind(const GlProgram& program) const;
  /// Draws the runs with the program in use; `channels` 1 or 3 chooses the textures, 0 binds none.
  void Draw(std::span<const DrawRun> runs, int channels);

 private:
  void Upload();
  void DrawShadowMap();
  GLuint TextureOf(int material, int channels);

  const GlFunctions* gl_;
  const SceneGeometry* geometry_;  // outlives this
  GLuint vertex_array_ = 0;
  GLuint shadow_map_ = 0;
  std::vector<GLuint> grey_textures_;    // by material; 0 until first needed
  std::vector<GLuint> colour_textures_;  // by material
};

}  // namespace alula::render::internal
