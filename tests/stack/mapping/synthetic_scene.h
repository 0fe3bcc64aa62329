#pragma once

#include <vector>

#include "base/frames.h"
#include "base/random.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"
#include "stack/mapping/depth_map.h"

namespace alula::stack::mapping::test {

/// A box of a test scene, drawn with a random texture of its own (or plain grey).
struct SceneBox {
  base::Transform X_OS;
  base::Vec3 half = base::Vec3::Constant(0.5);  // m
  bool plain = false;
};

/// A little ray-cast world: what the tests know exactly.
struct Scene {
  std::vector<SceneBox> boxes;

  /// Adds the four bars of a gate (x along the passage, origin mid-opening).
  void AddGate(const base::Transform& X_OG, double opening, double bar_width, double bar_depth);
  void AddBox(const base::Vec3& centre_O, const base::Vec3& half) {
    boxes.push_back({{base::Quat::Identity(), centre_O}, half});
  }

  struct Hit {
    double t = 0.0;  // in units of the ray's length; infinite where nothing is hit
    double grey = 0.0;
  };
  Hit Cast(const base::Vec3& origin_O, const base::Vec3& ray_O, bool shade) const;

  /// True planar depth at the pixels of `shape` (whose z is replaced); +inf where nothing is hit.
  DepthMap Depth(const DepthMap& shape, const base::Transform& X_OC) const;
  /// A grey image with 3×3 samples a pixel and Gaussian noise; sky is plain.
  Image Picture(const CameraIntrinsics& k, const base::Transform& X_OC, double noise, base::RandomStream& random) const;
};

/// 640×480, 80° horizontal, baseline 0.11 m, looking along body x; the right eye is turned by `misalignment` rad
/// about a fixed oblique axis.
Calibration StereoCalibration(double misalignment);
/// The depth map's geometry that this calibration gives at half size.
DepthMap HalfSizeShape();

/// Makes a depth map as stereo would: disparities with noise that is correlated over blocks of 5 pixels, a common
/// bias, and unknown pixels (a share, and a band of 2 pixels about depth edges).
DepthMap Corrupt(const DepthMap& truth, double disparity_sigma, double disparity_bias, double unknown_share,
                 base::RandomStream& random);

}  // namespace alula::stack::mapping::test
