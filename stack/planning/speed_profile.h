#pragma once

#include <optional>
#include <vector>

#include "stack/planning/trajectory.h"

namespace alula::stack::planning {

/// Speed along a curve: piecewise constant tangential acceleration on a fine grid of arc length.
struct SpeedProfile {
  std::vector<double> s;  // m
  std::vector<double> v;  // m/s
  std::vector<double> t;  // s since the start

  double Duration() const { return t.back(); }
  /// Arc length at a time; stands at the ends outside [0, Duration].
  double At(double time) const;
};

/// The fastest profile from start speed to end speed within the limits (max speed, climb speed, total acceleration,
/// heading rate, zones): a backward and a forward pass over the curve. `brake_scale` ≥ 1 multiplies the acceleration
/// allowed, and lets a start that is too fast for its zone slow down at that rate. Nothing when even so it is too fast.
std::optional<SpeedProfile> MakeSpeedProfile(const Curve& curve, double stop_at, double start_speed, double end_speed,
                                             const std::vector<SpeedZone>& zones, const TrajectoryLimits& limits,
                                             double brake_scale);

}  // namespace alula::stack::planning
