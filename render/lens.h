#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/camera_renderer.h"

namespace alula::render {

/// Bends pictures as a camera's lens does. A renderer draws pinhole pictures only: the lens says which of them (its
/// sources) hold all that the camera sees, and samples the image from them through a table made once. Usual lenses have
/// one source; those that see more than 60° off their axis have the used faces of a cube.
///
/// Sources lie one after another on a canvas (rows of `stride` pixels): whole, or only the rows that are needed.
class Lens {
 public:
  struct Source {
    base::Quat q_CS;                     // the source camera's axes in the camera's
    stack::CameraIntrinsics intrinsics;  // pinhole; all sources of a lens have one width
    std::size_t first_pixel = 0;         // of it on the canvas
  };
  struct Rows {
    int first = 0;
    int count = 0;
  };

  /// Throws base::InputError where the image reaches beyond the angle at which the lens folds it back.
  explicit Lens(const stack::CameraIntrinsics& camera);

  /// The image is the one source: nothing is to be sampled.
  bool is_pinhole() const { return pinhole_; }
  const std::vector<Source>& sources() const { return sources_; }
  std::size_t canvas_pixels() const { return canvas_pixels_; }
  /// Rows of a source from which rows [first, first + count) of the image are sampled.
  Rows RowsOf(std::size_t source, const Rows& image) const;

  /// Rows of the image, bilinearly, to 1/256 px. `canvas`: `channels` bytes a pixel. `out`: where the first of those
  /// rows goes. Equal on every machine.
  void Sample(const std::uint8_t* canvas, int channels, const Rows& image, std::uint8_t* out) const;
  /// Planar depth along the camera's own axis from the sources' planar depths (m, 0: nothing); the nearest pixel, so
  /// that no depth is made up at edges.
  void SampleDepth(const float* canvas, DepthPicture& out) const;

 private:
  void PlanSources(std::span<const base::Vec3> rays);
  void FillTable(std::span<const base::Vec3> rays);

  stack::CameraIntrinsics camera_;
  bool pinhole_ = false;
  std::vector<Source> sources_;
  std::size_t canvas_pixels_ = 0;
  // By pixel of the image: the source's pixel up and left of where the ray ends, how far beyond it (1/256 px), and
  // which source.
  std::vector<std::uint32_t> pixel_;
  std::vector<std::uint8_t> right_, down_, source_;
  std::vector<Rows> rows_;  // by source and row of the image
};

}  // namespace alula::render
