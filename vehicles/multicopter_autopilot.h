#pragma once

#include <memory>

#include "base/describe.h"
#include "base/time.h"
#include "vehicles/attitude_control.h"
#include "vehicles/error_state_filter.h"
#include "vehicles/position_control.h"
#include "vehicles/quadrotor.h"
#include "vehicles/vehicle.h"

namespace alula::vehicles {

/// When the autopilot takes matters into its own hands.
struct FailsafeConfig {
  base::Duration estimate_timeout = base::Milliseconds(500);  // without an estimate: no longer trust the position
  base::Duration hold_time = base::Seconds(3.0);              // silence is held this long, then the vehicle lands
  base::Duration ready_timeout = base::Seconds(10.0);         // armed on the ground without a take-off: disarm
  double descent_speed = 0.7;                                 // m/s
  double touchdown_speed = 0.3;                               // m/s, within touchdown_height of the take-off level
  double touchdown_height = 1.0;                              // m
};
void Describe(base::Description& d, FailsafeConfig& c);

struct MulticopterAutopilotConfig {
  /// What the autopilot was set up with; the vehicle that flies may be 5 % lighter or heavier.
  double assumed_mass = 0.75;  // kg
  double idle_command = 0.08;  // ESC command of an armed rotor on the ground
  ErrorStateFilterConfig filter;
  PositionControlConfig position;
  AttitudeControlConfig attitude;
  FailsafeConfig failsafe;
};
void Describe(base::Description& d, MulticopterAutopilotConfig& c);

/// A flight controller in PX4's cascade: position P → velocity PID → attitude P → rate PID → mixer, on the state of an
/// error-state Kalman filter of its own IMU (at the body origin, axes along the body's), its barometer and the stack's
/// estimates (external vision).
///
/// From the stack: `Arm` (kept until it expires or the filter is ready), then PositionSetpoint or VelocitySetpoint
/// that leads upwards takes off. Modes:
///
///   kDisarmed --Arm, filter ready--> kReady --set-point above--> kFollowing
///   kFollowing --commands expired, Hold, or estimates silent--> kHolding --hold_time of silence--> kLanding
///   any --Land--> kLanding --own land detector--> kDisarmed;  a newer set-point leaves kHolding and kLanding
///
/// Without estimates it damps its velocity by dead reckoning while holding and descends level, height by barometer.
/// Of `vehicle` it uses geometry, rotor and battery data, not the mass.
std::unique_ptr<Autopilot> MakeMulticopterAutopilot(const MulticopterAutopilotConfig& config,
                                                    const QuadrotorConfig& vehicle);

}  // namespace alula::vehicles
