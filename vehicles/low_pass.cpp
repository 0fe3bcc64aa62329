#include "vehicles/low_pass.h"

#include <cmath>

#include "base/error.h"

namespace alula::vehicles {

LowPass::LowPass(double cutoff, double sample_rate) {
  if (!(cutoff > 0 && cutoff < 0.5 * sample_rate)) {
    throw base::InputError("low-pass cut-off must lie between 0 and half the sample rate");
  }
  const double k = std::tan(M_PI * cutoff / sample_rate);
  const double norm = 1.0 / (1.0 + M_SQRT2 * k + k * k);
  b0_ = k * k * norm;
  b1_ = 2 * b0_;
  b2_ = b0_;
  a1_ = 2 * (k * k - 1) * norm;
  a2_ = (1 - M_SQRT2 * k + k * k) * norm;
}

base::Vec3 LowPass::Step(const base::Vec3& input) {
  if (!started_) {  // the state of a long constant input
    s2_ = (b2_ - a2_) * input;
    s1_ = (b1_ - a1_) * input + s2_;
    started_ = true;
  }
  const base::Vec3 output = b0_ * input + s1_;
  s1_ = b1_ * input - a1_ * output + s2_;
  s2_ = b2_ * input - a2_ * output;
  return output;
}

}  // namespace alula::vehicles
