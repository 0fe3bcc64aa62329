#pragma once

#include <memory>

#include "base/describe.h"
#include "stack/interface/calibration.h"
#include "stack/mapping/depth_map.h"

namespace alula::stack::mapping {

/// Semi-global matching on rectified images at half size. Lengths in px are of the half-size images.
struct StereoDepthConfig {
  double min_depth = 0.45;  // m; nearer things are not matched: sets the disparity range (and the cost)
  int block = 5;            // px, odd; larger is smoother and fattens thin bars more
  double smoothness =
      1.0;  // penalty scale of SGBM (P1 = 8·s·block², P2 = 4·P1); too low: noise, too high: thin bars melt
  int uniqueness = 8;                 // %, by how much the best cost must beat the second
  double left_right_tolerance = 1.0;  // px; a match that does not come back this near is an occlusion
  int speckle_area = 60;              // px; smaller islands of disparity are dropped
  double speckle_range = 1.5;         // px, jump that separates islands
  double min_texture = 2.0;           // mean |horizontal gradient| in the window, grey levels; below: unknown (sky)
  int texture_window = 7;             // px, odd
  double edge_jump = 1.5;             // px of disparity; a larger jump within two pixels is a depth edge
  int refinements = 1;                // sub-pixel steps: without, whole surfaces are pulled to full pixels by 0.25 px
  int refine_window = 7;              // px, odd
  double far_disparity = 0.5;         // px; valid disparities below this are "free to the limit"
};
void Describe(base::Description& d, StereoDepthConfig& c);

/// Rectification and dense matching of a stereo pair. Immutable after construction: Compute may run in any thread.
class StereoDepth {
 public:
  /// Throws base::InputError when the calibration has no stereo pair or the two eyes do not look the same way.
  StereoDepth(const Calibration& calibration, const StereoDepthConfig& config);
  ~StereoDepth();
  StereoDepth(StereoDepth&&) noexcept;
  StereoDepth& operator=(StereoDepth&&) noexcept;

  /// The depth seen by the rectified left camera, half the size of the images. Grey images of the calibrated size;
  /// throws base::InputError otherwise.
  DepthMap Compute(const Image& left, const Image& right) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::mapping
