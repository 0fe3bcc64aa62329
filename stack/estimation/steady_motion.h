#pragma once

#include <vector>

#include "stack/estimation/odometry.h"

namespace alula::stack::estimation {

/// What an IMU in a world without gravity would read of a body that goes on as it does: turn rate `rate` (rad/s), no
/// acceleration. Samples from `from` to `to`, both included, enough of them for their covariance to have full rank.
std::vector<TimedImu> SteadySamples(base::Time from, base::Time to, const base::Vec3& rate);

/// How much is believed of it; its biases hardly move.
ImuNoise SteadyNoise(const MotionConfig& config);

}  // namespace alula::stack::estimation
