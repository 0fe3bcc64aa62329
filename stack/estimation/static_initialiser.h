#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "stack/estimation/odometry.h"

namespace alula::stack::estimation {

/// Attitude and gyroscope bias of an IMU that stands still. The accelerometer's bias cannot be told from tilt here: it
/// is left at zero, and its uncertainty to whoever solves further.
struct StandstillState {
  base::Quat q_OI;
  base::Vec3 gyro_bias;
};

/// From the mean of samples at rest. Specific force points up (against gravity); heading such that the body's heading
/// (q_BI) equals `yaw`. None where the mean force is not within 15 % of gravity or the mean rate is above 0.2 rad/s.
std::optional<StandstillState> FromStandstill(const std::vector<TimedImu>& samples, const base::Quat& q_BI, double yaw);

}  // namespace alula::stack::estimation
