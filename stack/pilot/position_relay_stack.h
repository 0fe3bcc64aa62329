#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/describe.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "stack/planning/trajectory.h"

namespace alula::stack::pilot {

/// The scripted stack: passes positions on, flies set-points.
struct PositionRelayConfig {
  double cruise_speed = 1.0;                                  // m/s between waypoints
  double max_acceleration = 1.5;                              // m/s²
  double climb_speed = 0.7;                                   // m/s during take-off
  double takeoff_height = 1.2;                                // m above the place of take-off
  double arrival_radius = 0.35;                               // m; a waypoint is left when the vehicle is this near …
  base::Duration dwell = base::Milliseconds(1000);            // … and its set-point has stood still for this long
  base::Duration velocity_time = base::Milliseconds(120);     // time constant of the differentiated position
  double velocity_sigma = 0.5;                                // m/s, stated 1σ of that velocity (noise and lag)
  base::Duration setpoint_period = base::Milliseconds(20);    // 50 Hz
  base::Duration command_lifetime = base::Milliseconds(500);  // then the autopilot treats the stack as silent
  base::Duration fix_timeout = base::Milliseconds(500);       // no position for this long: land
};
void Describe(base::Description& d, PositionRelayConfig& c);

/// A stack without a camera: each PositionFix becomes an Estimate (stamp = captured, X_OB = the fix, X_MO = identity,
/// velocity = first-order filtered difference of positions, which lags by `velocity_time` and therefore carries a large
/// covariance). It arms when the autopilot is ready, climbs, visits Mission::waypoints in order on straight legs with
/// bounded velocity and acceleration, lands, and is kDone once the autopilot has disarmed.
std::unique_ptr<NavigationStack> MakePositionRelayStack(const Calibration& calibration, const Mission& mission,
                                                        const PositionRelayConfig& config);

}  // namespace alula::stack::pilot
