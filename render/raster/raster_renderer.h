#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/camera_renderer.h"
#include "render/internal/air_and_lamps.h"
#include "render/raster/clipper.h"
#include "render/raster/packed_textures.h"
#include "render/raster/raster_scene.h"
#include "render/raster/shadow_map.h"
#include "render/raster/visibility_buffer.h"

namespace alula::render::raster {

/// The renderer on the processor. Each picture: order the batches nearest first, draw them into the visibility buffer,
/// shade it.
class RasterRenderer final : public CameraRenderer {
 public:
  RasterRenderer(const Kernels& kernels, const worlds::World& world, std::span<const Mover> movers);

  void PlaceMovers(std::span<const base::Transform> X_WM) override;
  void Grey(const View& view, Picture& out) override { Paint(view, 1, out); }
  void Colour(const View& view, Picture& out) override { Paint(view, 3, out); }
  void Depth(const View& view, DepthPicture& out) override;
  void Surface(const View& view, SurfacePicture& out) override;
  std::string Description() const override { return std::string("raster ") + kernels_->name; }

 private:
  RasterRenderer(const Kernels& kernels, internal::SceneGeometry geometry, const worlds::World& world,
                 std::span<const Mover> movers);
  void Paint(const View& view, int channels, Picture& out);
  /// The visibility buffer of a view; without ids for depth alone.
  Target DrawView(const View& view, bool with_ids);
  /// Triangles that must be clipped, and those with holes.
  void DrawSingly(const Target& target, std::uint32_t triangle, bool has_holes);
  const PackedTextures& Textures(int channels, bool infrared);
  void ShadeLit(const View& view, const internal::AirAndLamps& air, const ShadeJob& shade);
  NormalJob NormalsFor(const Target& target);

  const Kernels* kernels_;
  worlds::Light light_;
  internal::ShadowFrame shadow_frame_;
  RasterScene scene_;
  PackedTextures alpha_;
  ShadowMap shadow_map_;
  std::vector<base::Transform> X_WM_;
  std::optional<PackedTextures> grey_;
  std::optional<PackedTextures> infrared_;
  std::optional<PackedTextures> colour_;
  std::vector<worlds::SemanticClass> classes_;  // by instance
  std::uint32_t frame_ = 0;
  // Scratch of a picture.
  std::vector<std::uint32_t> drawn_numbers_;
  DrawnList drawn_{};
  std::vector<TrianglePlanes> planes_;
  std::vector<NormalPlanes> normal_planes_;
  std::vector<Lamp> lamps_;
  VisibilityBuffer buffer_;
  std::vector<std::uint32_t> to_clip_;
  std::vector<Corner> polygon_;
};

}  // namespace alula::render::raster
