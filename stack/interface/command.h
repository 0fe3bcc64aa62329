#pragma once

#include <variant>

#include "base/frames.h"
#include "base/time.h"

namespace alula::stack {

struct Arm {};
struct Disarm {};

/// Follow a point of a trajectory: position, velocity and acceleration in the odometry frame O (m, m/s, m/s²), and
/// heading (rad, rad/s).
struct PositionSetpoint {
  base::Vec3 p_OB = base::Vec3::Zero();
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Vec3 a_OB = base::Vec3::Zero();
  double yaw = 0.0;
  double yaw_rate = 0.0;
};

struct VelocitySetpoint {
  base::Vec3 v_OB = base::Vec3::Zero();
  double yaw = 0.0;
  double yaw_rate = 0.0;
};

/// Turn a gimbal: its number in the calibration and the angles wanted (rad), against the body, or against the horizon
/// and the heading where it is stabilised. The mount obeys, not the autopilot; it keeps the last one.
struct GimbalSetpoint {
  int gimbal = 0;
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
};

/// Stay where you are.
struct Hold {};
/// Come down here, and disarm on the ground.
struct Land {};

/// A command with a time of expiry: after it the autopilot behaves as if the stack were silent.
struct Command {
  std::variant<Arm, Disarm, PositionSetpoint, VelocitySetpoint, Hold, Land, GimbalSetpoint> what;
  base::Time issued;
  base::Time expires;
};

}  // namespace alula::stack
