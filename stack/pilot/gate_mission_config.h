#pragma once

#include "base/describe.h"
#include "base/time.h"

namespace alula::stack::pilot {

struct GateMissionConfig {
  double takeoff_height = 1.2;   // m above the pad
  double takeoff_speed = 0.8;    // m/s
  double scan_half_angle = 1.3;  // rad to each side of the start heading
  double scan_rate = 1.2;        // rad/s
  double good_sigma = 0.08;      // m in the opening's plane: a gate measured this well may be entered
  double good_range = 3.6;       // m; it must have been seen from this near
  double coarse_sigma = 0.16;    // m, accepted after the first look in vain
  double freeze_distance = 1.1;  // m before the plane: the frame leaves the view, the fit is kept
  double view_distance = 2.2;    // m before a gate that is not measured well enough
  base::Duration look_time = base::Milliseconds(1500);      // at a view point before another is tried
  base::Duration stuck_time = base::Milliseconds(1000);     // at rest without progress before recovery
  base::Duration lost_time = base::Milliseconds(2500);      // without healthy odometry before landing
  base::Duration setpoint_period = base::Milliseconds(10);  // 100 Hz
  base::Duration command_lifetime = base::Milliseconds(500);
  double arrival_radius = 0.3;      // m, at the target
  double tracking_tolerance = 0.9;  // m between set-point and estimate before the mission starts over from a hover
  double creep_speed = 0.6;         // m/s where recovery flies on into space that was hardly seen
  /// Control experiment: take the gates from the mission's list, as if they had been measured there.
  bool trust_gate_list = false;
};
void Describe(base::Description& d, GateMissionConfig& c);

}  // namespace alula::stack::pilot
