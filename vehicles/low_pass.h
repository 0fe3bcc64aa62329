#pragma once

#include "base/frames.h"

namespace alula::vehicles {

/// Second-order Butterworth low-pass of a vector (bilinear transform, prewarped); its first input sets its state.
class LowPass {
 public:
  /// Both in Hz; the cut-off lies below half the sample rate.
  LowPass(double cutoff, double sample_rate);
  base::Vec3 Step(const base::Vec3& input);

 private:
  double b0_, b1_, b2_, a1_, a2_;
  bool started_ = false;
  base::Vec3 s1_ = base::Vec3::Zero(), s2_ = base::Vec3::Zero();  // transposed direct form II
};

}  // namespace alula::vehicles
