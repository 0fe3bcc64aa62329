#pragma once

#include <memory>

#include "base/describe.h"
#include "vehicles/attitude_control.h"
#include "vehicles/error_state_filter.h"
#include "vehicles/flight_modes.h"
#include "vehicles/land_detector.h"
#include "vehicles/position_control.h"
#include "vehicles/quadrotor.h"
#include "vehicles/vehicle.h"

namespace alula::vehicles {

struct MulticopterAutopilotConfig {
  /// What the autopilot was set up with; the vehicle that flies may be 5 % lighter or heavier.
  double assumed_mass = 0.75;  // kg
  double idle_command = 0.08;  // ESC command of an armed rotor on the ground
  ErrorStateFilterConfig filter;
  PositionControlConfig position;
  AttitudeControlConfig attitude;
  FailsafeConfig failsafe;
  LandDetectorConfig landing;
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
