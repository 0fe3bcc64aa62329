#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "render/camera_renderer.h"
#include "render/internal/air_and_lamps.h"
#include "render/internal/gl_context.h"
#include "render/internal/gpu_scene.h"
#include "render/internal/render_target.h"
#include "render/internal/surface_classes.h"

namespace alula::render::internal {

/// The renderer on any GL context. Each call: bind the context, bind a framebuffer, draw what the view sees nearest
/// first, fill the rest with sky, read back, release the context.
class GlRenderer final : public CameraRenderer {
 public:
  struct Options {
    bool cull = true;     // false draws what lies outside the view too: the reference for tests
    bool levels = true;   // of detail; false draws everything at its full level
    bool shadows = true;  // false lights what faces the sun, whatever stands between
  };
  GlRenderer(std::unique_ptr<GlContext> context, const worlds::World& world, std::span<const Mover> movers,
             Options options);
  GlRenderer(std::unique_ptr<GlContext> context, std::shared_ptr<const SceneGeometry> scene, Options options);

  std::unique_ptr<CameraRenderer> Twin() const override;
  void PlaceMovers(std::span<const base::Transform> X_WM) override;
  void Grey(const View& view, Picture& out) override;
  void Colour(const View& view, Picture& out) override;
  void Depth(const View& view, DepthPicture& out) override;
  void Surface(const View& view, SurfacePicture& out) override;
  bool Has(worlds::SemanticClass semantic) const override { return geometry_->Has(semantic); }
  std::string Description() const override { return description_; }

 private:
  /// Grey or colour into the bound framebuffer.
  void Paint(const View& view, int channels);
  /// What has no holes with the one program, what has some with the other.
  using Programs = std::array<const GlProgram*, 2>;
  void DrawSurfaces(const View& view, const Programs& programs, TextureKind kind);
  void DrawMovers(const View& view, const GlProgram& program, TextureKind kind, bool holes);
  void DrawInstances(const View& view);
  void DrawSky(const View& view, int channels, const AirAndLamps& air);
  /// A program of a pass, made when first needed.
  enum class Pass { kGrey, kColour, kDepth, kNormal };
  const GlProgram& Program(Pass pass, bool lit, bool holes);
  Programs ProgramsOf(Pass pass, bool lit = false);
  void Begin(const View& view, PixelKind kind);
  /// The longer focal length, or infinity where levels of detail are not wanted.
  double FocalFor(const View& view) const;
  void CheckErrors() const;

  std::unique_ptr<GlContext> context_;
  Options options_;
  std::shared_ptr<const SceneGeometry> geometry_;
  std::vector<base::Transform> X_WM_;
  bool shadows_are_current_ = false;
  std::string description_;
  std::vector<std::uint8_t> rgba_;  // scratch of the colour pass
  std::vector<float> surface_;      // scratch of the surface pass
  // Made once the context is current.
  std::unique_ptr<GpuScene> scene_;
  std::unique_ptr<RenderTargets> targets_;
  std::unique_ptr<GlProgram> sky_, foggy_sky_;
  std::array<std::unique_ptr<GlProgram>, 16> programs_;  // by pass, lit, holes
};

}  // namespace alula::render::internal
