#pragma once

#include <map>
#include <memory>
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
  GpuScene(const GlFunctions& gl, const SceneGeometry& geometry);

  /// Binds buffers and the shadow map and gives the program in use the light.
  void Bind(const GlProgram& program) const;
  /// Draws the shadows of movers at new places; the framebuffer in use is another one then.
  void PlaceShadows(std::span<const base::Transform> X_WM);
  /// Whether anything has holes.
  bool HasHoles() const { return has_holes_; }
  /// Draws the runs with the program in use and textures of the kind (and the holes of those that have some).
  void Draw(std::span<const DrawRun> runs, TextureKind kind);

 private:
  void Upload();
  /// A texture of distances from the sun with its framebuffer, which is bound then.
  struct ShadowTarget {
    GLuint texture = 0;
    GLuint framebuffer = 0;
  };
  ShadowTarget MakeShadowTarget() const;
  void DrawStaticShadows();
  /// Casters into the shadow framebuffer in use, within a region; statics where `mover` is null.
  void DrawCasters(const ShadowRegion& region, const Batch* mover, const base::Transform& X_WM);
  GLuint TextureOf(int material, TextureKind kind);
  GLuint AlphaOf(int material);

  const GlFunctions* gl_;
  const SceneGeometry* geometry_;  // outlives this
  bool has_holes_ = false;
  GLuint vertex_array_ = 0;
  ShadowTarget shadow_map_;                   // that pictures look up
  ShadowTarget static_shadows_;               // without movers; made where there are some
  std::vector<ShadowRegion> shadow_regions_;  // where movers' shadows are drawn
  std::unique_ptr<GlProgram> caster_, caster_with_holes_;
  std::map<int, GLuint> alphas_;                            // of materials with holes
  std::map<std::pair<TextureKind, int>, GLuint> textures_;  // by kind and material, made when first needed
};

}  // namespace alula::render::internal
