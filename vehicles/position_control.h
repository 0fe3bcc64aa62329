#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::vehicles {

struct PositionControlConfig {
  double position_gain = 2.5;           // 1/s
  double velocity_gain = 5.0;           // 1/s
  double velocity_integral = 1.5;       // 1/s²
  double vertical_position_gain = 2.0;  // 1/s
  double vertical_velocity_gain = 6.0;  // 1/s
  double vertical_integral = 3.0;       // 1/s²
  double maximum_speed = 6.0;           // m/s, horizontally
  double maximum_climb = 2.0;           // m/s, for corrections of height
  double maximum_descent = 1.5;         // m/s
  double maximum_correction = 2.5;      // m/s that the position loop may add to the set-point's velocity
  double maximum_tilt = 0.70;           // rad (40°)
  double minimum_thrust = 0.15;         // least collective in flight, share of weight: attitude stays controllable
  double maximum_integral = 3.5;        // m/s²: wind and drag
  double drag_compensation = 0.3;       // 1/s, rotor drag of the set-point's velocity, fed forward
  /// Acceleration and jerk of the set-point are taken this much ahead, s: what attitude and motors lag behind.
  double acceleration_lead = 0.10;
};
void Describe(base::Description& d, PositionControlConfig& c);

/// What to follow. Axes whose position is not controlled leave `position_weight` at zero there.
struct MotionSetpoint {
  base::Vec3 p_OB = base::Vec3::Zero();
  base::Vec3 v_OB = base::Vec3::Zero();
  base::Vec3 a_OB = base::Vec3::Zero();
  base::Vec3 jerk_OB = base::Vec3::Zero();  // m/s³
  double yaw = 0.0;
  double yaw_rate = 0.0;
  base::Vec3 position_weight = base::Vec3::Ones();
};

/// PX4's outer cascade: v = v_ff + K_p (p_sp − p), a = a_ff + K_v (v − v_B) + ∫ K_i (v − v_B) + drag; the thrust
/// direction is a + g within the tilt limit (height first), and integrals stop where the output saturates
/// (PX4, PositionControl.cpp; Mueller, Hehn and D'Andrea 2015 for the limits).
class PositionControl {
 public:
  explicit PositionControl(const PositionControlConfig& config) : config_(config) {}

  /// Returns specific thrust f (m/s², odometry axes; mass times it is the thrust wanted), gravity included.
  /// `maximum_thrust`: m/s². `climb_limit`: m/s, below maximum_climb while taking off. `integrate`: false on the
  /// ground.
  base::Vec3 Step(const MotionSetpoint& setpoint, const base::Vec3& p_OB, const base::Vec3& v_OB, double maximum_thrust,
                  double climb_limit, bool integrate, double dt);

  void Reset() { integral_.setZero(); }
  const base::Vec3& integral() const { return integral_; }

 private:
  base::Vec3 VelocitySetpoint(const MotionSetpoint& setpoint, const base::Vec3& p_OB, double climb_limit) const;

  PositionControlConfig config_;
  base::Vec3 integral_ = base::Vec3::Zero();  // m/s²
};

/// `f` shortened horizontally until it tilts by no more than `maximum_tilt` and is no longer than `maximum`, its
/// vertical part kept where possible.
base::Vec3 LimitThrust(const base::Vec3& f, double maximum_tilt, double minimum, double maximum);

}  // namespace alula::vehicles
