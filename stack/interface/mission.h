#pragma once

#include <string>
#include <vector>

#include "base/frames.h"

namespace alula::stack {

/// A gate as the mission states it: where it is thought to be, not where it is.
struct GateHint {
  std::string name;
  base::Transform X_WG;  // x along the direction of passage, z up, origin mid-opening
  double opening = 0.0;  // side of the square opening, m
};

/// Everything a stack is told about its task. Poses are in the world as surveyed, and wrong as surveys are.
struct Mission {
  base::Transform X_WB_start;
  double start_position_sigma = 0.0;  // m
  double start_yaw_sigma = 0.0;       // rad
  /// Radius of the column above the pad that is declared free for take-off, m.
  double takeoff_column_radius = 0.0;
  std::vector<GateHint> gates;       // in order of passage
  double gate_position_error = 0.0;  // bound on the error of a hint in the opening's plane, m
  double gate_angle_error = 0.0;     // bound, rad
  /// Waypoints for stacks that fly set-points, in order.
  std::vector<base::Vec3> waypoints;
  base::Vec3 target = base::Vec3::Zero();
  /// The vehicle may not leave this box (world frame).
  base::Vec3 bounds_low = base::Vec3::Zero();
  base::Vec3 bounds_high = base::Vec3::Zero();
};

}  // namespace alula::stack
