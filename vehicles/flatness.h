#pragma once

#include "base/frames.h"

namespace alula::vehicles {

/// Attitude and angular velocity of a multicopter.
struct FlatAttitude {
  base::Quat q_WB = base::Quat::Identity();
  base::Vec3 w_B = base::Vec3::Zero();  // rad/s
};

/// The body frame whose z axis lies along a + g and whose x axis points along `yaw`, and how it turns, from
/// acceleration (m/s²), jerk (m/s³), yaw (rad) and yaw rate (rad/s): differential flatness, Mellinger and Kumar 2011,
/// section III, with the heading of base/frames.h: x_B lies above or below the heading direction. a + g must not be
/// horizontal.
FlatAttitude AttitudeFromThrust(const base::Vec3& a_W, const base::Vec3& jerk_W, double yaw, double yaw_rate);

}  // namespace alula::vehicles
