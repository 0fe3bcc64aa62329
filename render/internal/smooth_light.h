#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/frames.h"
#include "render/image_sensor.h"

namespace alula::render::internal {

/// Light that is added to a picture and varies slowly over it: the haze of dirt and glare. It is worked out at nodes 8
/// px apart and interpolated between them.
class SmoothLight {
 public:
  static constexpr int kCell = 8;

  /// `scattered`: share of each pixel's light that dirt spreads; empty: none.
  SmoothLight(const Glare& glare, std::span<const float> scattered, const stack::CameraIntrinsics& camera,
              int channels);

  /// Grey levels at the nodes, channels interleaved. Empty where nothing is added.
  std::vector<float> Nodes(const Picture& picture, const FrameSettings& frame) const;
  /// Row v, by byte of the picture. `out`: room for row_size() floats.
  void Row(std::span<const float> nodes, int v, std::vector<float>& out) const;

 private:
  void AddHaze(const Picture& picture, std::vector<float>& nodes) const;
  void AddGlare(const GlareLight& light, double brightness, std::vector<float>& nodes) const;

  Glare glare_;
  stack::CameraIntrinsics camera_;
  int channels_ = 1;
  int columns_ = 0, rows_ = 0;    // of nodes
  std::vector<float> haze_;       // by node; empty: none
  std::vector<base::Vec3> rays_;  // by node, unit vectors; empty where glare is off
};

}  // namespace alula::render::internal
