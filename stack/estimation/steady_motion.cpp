#include "stack/estimation/steady_motion.h"

namespace alula::stack::estimation {

std::vector<TimedImu> SteadySamples(base::Time from, base::Time to, const base::Vec3& rate) {
  constexpr int kSteps = 4;
  std::vector<TimedImu> samples;
  for (int i = 0; i <= kSteps; ++i) {
    TimedImu sample;
    sample.time = {from.ns + (to.ns - from.ns) * i / kSteps};
    sample.gyro = rate;
    samples.push_back(sample);
  }
  return samples;
}

ImuNoise SteadyNoise(const MotionConfig& config) {
  constexpr double kBiasWalk = 1e-6;  // keeps their blocks solvable
  ImuNoise noise;
  noise.gyro_noise = config.turn;
  noise.accelerometer_noise = config.acceleration;
  noise.gyro_bias_walk = noise.accelerometer_bias_walk = kBiasWalk;
  return noise;
}

}  // namespace alula::stack::estimation
