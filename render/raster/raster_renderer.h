#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/camera_renderer.h"
#include "render/internal/air_and_lamps.h"
#include "render/raster/clipper.h"
#include "render/raster/raster_scene.h"
#include "render/raster/view_vertices.h"
#include "render/raster/visibility_buffer.h"

namespace alula::render::raster {

/// The renderer on the processor. Each picture: order the batches nearest first, draw them into the visibility buffer,
/// shade it. The scene is shared with the twins; all else is scratch of this renderer.
class RasterRenderer final : public CameraRenderer {
 public:
  RasterRenderer(const Kernels& kernels, const worlds::World& world, std::span<const Mover> movers);
  RasterRenderer(const Kernels& kernels, std::shared_ptr<const RasterScene> scene);

  std::unique_ptr<CameraRenderer> Twin() const override;
  void PlaceMovers(std::span<const base::Transform> X_WM) override;
  void Grey(const View& view, Picture& out) override { Paint(view, 1, out); }
  void Colour(const View& view, Picture& out) override { Paint(view, 3, out); }
  void Depth(const View& view, DepthPicture& out) override;
  void Surface(const View& view, SurfacePicture& out) override;
  bool Has(worlds::SemanticClass semantic) const override { return scene_->geometry().Has(semantic); }
  std::string Description() const override { return std::string("raster ") + kernels_->name; }

 private:
  /// Where a mover stands; its attributes are made when a picture first shows it there.
  struct Placed {
    base::Transform X_WM;
    const internal::Level* lit = nullptr;  // the level whose attributes are those of X_WM
  };
  void Paint(const View& view, int channels, Picture& out);
  /// The visibility buffer of a view; without ids for depth alone.
  Target DrawView(const View& view, bool with_ids);
  /// Triangles of a level whose vertices have been transformed by m.
  void DrawLevel(const internal::Batch& batch, const internal::Level& level, const std::array<float, 12>& m,
                 const Target& target);
  void DrawMover(const View& view, std::size_t number, const Target& target);
  /// Nearest first, by the mean of their corners: holes need not be looked up where a nearer triangle has won.
  void SortByDepth(std::span<std::uint32_t> triangles);
  /// Triangles that must be clipped, and those with holes.
  void DrawSingly(const Target& target, std::uint32_t triangle, bool has_holes);
  void ShadeLit(const View& view, const internal::AirAndLamps& air, const ShadeJob& shade);
  NormalJob NormalsFor(const Target& target);
  /// The map of the sun with the movers where they stand.
  const ShadowMap& Shadows();
  ShadeJob JobFor(const View& view, int channels, const Target& target);

  const Kernels* kernels_;
  std::shared_ptr<const RasterScene> scene_;
  std::vector<internal::Batch> boxes_;  // the statics', then the movers' in the world
  std::vector<Placed> movers_;
  std::vector<base::Transform> X_WM_;
  std::vector<float> mover_attributes_;
  std::vector<float> mover_normals_;
  MoverShadows mover_shadows_;
  const ShadowMap* shadows_ = nullptr;
  bool shadows_are_current_ = false;
  std::uint32_t frame_ = 0;
  // Scratch of a picture.
  ViewVertices vertices_;
  std::vector<std::uint32_t> drawn_numbers_;
  DrawnList drawn_{};
  std::vector<TrianglePlanes> planes_;
  std::vector<NormalPlanes> normal_planes_;
  std::vector<Lamp> lamps_;
  std::vector<MoverShadow> mover_regions_;
  VisibilityBuffer buffer_;
  std::vector<std::uint32_t> to_clip_;
  std::vector<std::pair<float, std::uint32_t>> by_depth_;  // three times the mean depth, triangle
  std::vector<Corner> polygon_;
};

}  // namespace alula::render::raster
