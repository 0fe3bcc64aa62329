#pragma once

#include <vector>

#include "base/frames.h"
#include "stack/features/stereo_tracker.h"

namespace alula::stack::estimation {

/// How the right camera moves, in its own axes.
struct EyeMotion {
  base::Vec3 v = base::Vec3::Zero();  // m/s
  base::Vec3 w = base::Vec3::Zero();  // rad/s
};

/// How much later than the left eye the right one saw (P3: eyes that no common trigger holds together). What moves past
/// is off its epipolar line by delay × its speed across that line, in pixels far above the noise and whatever its
/// depth: a straight line through the errors of a pair has the delay as its slope. Its offset, an eye turned a little
/// against the other, is learnt over many pairs.
class EyeDelay {
 public:
  explicit EyeDelay(const features::StereoRig& rig) : rig_(rig), X_RL_(rig.X_LR.Inverse()) {}

  /// Velocity (1/s, normalised) with which the right eye sees a point pass.
  base::Vec2 Velocity(const features::Track& track, const EyeMotion& motion) const;

  /// Takes a pair in. Returns its delay, s: its own where its motion shows one clearly, else the usual one where that
  /// is certain, else 0.
  double Update(const std::vector<features::Track>& tracks, const EyeMotion& motion);

  /// Over the last half minute, with 1σ, s.
  double usual() const { return usual_; }
  double sigma() const { return sigma_; }

 private:
  struct Sums {
    double n = 0, v = 0, vv = 0, e = 0, ev = 0;
  };

  features::StereoRig rig_;
  base::Transform X_RL_;
  Sums past_;
  double usual_ = 0.0, sigma_ = 1.0, offset_ = 0.0;
};

}  // namespace alula::stack::estimation
