#include "stack/pilot/gate_mission_config.h"

namespace alula::stack::pilot {

void Describe(base::Description& d, GateMissionConfig& c) {
  d.Field("takeoff_height", c.takeoff_height,
          {.unit = "m", .meaning = "above the pad, in the trusted column", .min = 0.3, .max = 20});
  d.Field("takeoff_speed", c.takeoff_speed, {.unit = "m/s", .meaning = "of the climb", .min = 0.1, .max = 5});
  d.Field("scan_half_angle", c.scan_half_angle,
          {.unit = "rad", .meaning = "the first look around, to each side", .min = 0, .max = 3.1416});
  d.Field("scan_rate", c.scan_rate, {.unit = "rad/s", .meaning = "heading rate of looks around", .min = 0.1, .max = 3});
  d.Field("good_sigma", c.good_sigma,
          {.unit = "m", .meaning = "a gate measured this well may be entered", .min = 0.001, .max = 2});
  d.Field("good_range", c.good_range,
          {.unit = "m", .meaning = "it must have been seen from this near", .min = 0.5, .max = 20});
  d.Field("coarse_sigma", c.coarse_sigma,
          {.unit = "m", .meaning = "accepted after a look in vain", .min = 0.001, .max = 2});
  d.Field("freeze_distance", c.freeze_distance,
          {.unit = "m", .meaning = "before the plane, from where on the fit is kept", .min = 0.1, .max = 5});
  d.Field("view_distance", c.view_distance,
          {.unit = "m", .meaning = "of the view point before a gate not measured yet", .min = 1, .max = 10});
  d.Field("look_time", c.look_time, {.unit = "s", .meaning = "at a view point before another one is tried"});
  d.Field("stuck_time", c.stuck_time, {.unit = "s", .meaning = "at rest without progress before recovery"});
  d.Field("lost_time", c.lost_time, {.unit = "s", .meaning = "without healthy odometry before landing"});
  d.Field("setpoint_period", c.setpoint_period, {.unit = "s", .meaning = "between set-points"});
  d.Field("command_lifetime", c.command_lifetime, {.unit = "s", .meaning = "after which a command expires"});
  d.Field("arrival_radius", c.arrival_radius, {.unit = "m", .meaning = "at the target", .min = 0.02, .max = 10});
  d.Field("tracking_tolerance", c.tracking_tolerance,
          {.unit = "m", .meaning = "between set-point and estimate before starting over", .min = 0.1, .max = 10});
  d.Field("creep_speed", c.creep_speed,
          {.unit = "m/s", .meaning = "of recovery into space hardly seen", .min = 0.1, .max = 5});
  d.Field("trust_gate_list", c.trust_gate_list,
          {.meaning = "control experiment: fly through the listed gates, not the measured ones"});
}

}  // namespace alula::stack::pilot
