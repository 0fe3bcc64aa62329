#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera_renderer.h"

namespace alula::render {

// Pictures that follow from depth and surfaces by geometry alone, whichever maker drew them.

/// Distance from the camera's centre along each pixel's ray, m; 0 where nothing is seen.
struct RangePicture {
  int width = 0;
  int height = 0;
  std::vector<float> metres;
};
/// range = depth · |((u − cx) / fx, (v − cy) / fy, 1)|. Throws base::FaultError where the sizes do not fit.
void RangeFromDepth(const View& view, const DepthPicture& depth, RangePicture& out);

/// What becomes of a pixel's point in the second view of an optical flow.
enum class FlowFate : std::uint8_t {
  kNothing,  // nothing was seen at the pixel: no motion is known
  kSeen,     // the point lies in the second picture, and nothing is known to lie before it
  kHidden,   // it lies in the second picture behind something nearer
  kOutside,  // it has left the second picture
  kBehind,   // it is nearer than the near plane or behind the second camera: no motion is known
};

/// Motion of each pixel's point of a surface, px: (u, v) in the second view less (u, v) in the first; NaN where it is
/// not known. A point that leaves the picture or is hidden in the second view keeps its motion; `fates` tells.
struct FlowPicture {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector2f> motion;
  std::vector<FlowFate> fates;
};

/// A view with the movers' poses at its time, in the order they were given at the renderer's making.
struct Moment {
  View view;
  std::span<const base::Transform> X_WM;
};

/// With x_1 = (u, v) of a pixel and d its depth: p_W = X_WC1 · d ((u − cx) / fx, (v − cy) / fy, 1), moved with its
/// mover to X_WM2 · X_WM1⁻¹ · p_W, and projected into the second view. `depth` and `surface` are of the first view.
/// `second_depth` (of the second view) tells what is hidden; null: nothing is taken to be hidden.
/// Throws base::FaultError where sizes or numbers of movers do not fit.
void OpticalFlow(const Moment& first, const DepthPicture& depth, const SurfacePicture& surface, const Moment& second,
                 const DepthPicture* second_depth, FlowPicture& out);

}  // namespace alula::render
