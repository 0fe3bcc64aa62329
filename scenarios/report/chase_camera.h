#pragma once

#include "base/frames.h"
#include "base/time.h"

namespace alula::scenarios {

/// A camera that follows a vehicle from behind and above, smoothly, and stays inside a box (the world's walls).
class ChaseCamera {
 public:
  ChaseCamera(const base::Vec3& low_W, const base::Vec3& high_W) : low_W_(low_W), high_W_(high_W) {}

  /// Pose X_WC of the camera (right-down-forward axes) for a vehicle at X_WB, `dt` after the last call.
  base::Transform Follow(const base::Transform& X_WB, base::Duration dt);

 private:
  base::Vec3 low_W_;
  base::Vec3 high_W_;
  base::Vec3 p_WC_ = base::Vec3::Zero();
  base::Vec3 look_W_ = base::Vec3::Zero();
  double yaw_ = 0.0;
  bool started_ = false;
};

/// Pose of a camera at `eye` that looks at `target`, image upright. World axes, z up; the two must differ horizontally.
base::Transform LookAt(const base::Vec3& eye_W, const base::Vec3& target_W);

}  // namespace alula::scenarios
