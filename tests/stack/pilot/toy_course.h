#pragma once

#include <string>
#include <vector>

#include "stack/interface/mission.h"
#include "stack/pilot/gate_mission.h"
#include "tests/stack/planning/synthetic_map.h"

namespace alula::tests {

/// A course for the mission's logic alone: a kinematic vehicle that follows its set-points with some lag, a camera that
/// reveals a perfect map, and gates that are measured when they are in view. No image is rendered.
struct ToyCourse {
  std::vector<stack::GateHint> truth;
  std::vector<base::Transform> boxes;  // 0.8 m cubes
  stack::Mission mission;              // its gates may be wrong
  stack::pilot::GateMissionConfig config;
  stack::planning::RouteConfig route;
  bool blind_to_gates = false;                     // no gate is ever measured
  double lose_odometry_at = -1.0, lose_for = 0.0;  // s
  double time_limit = 90.0;                        // s

  /// Five gates in a courtyard of 30 m × 20 m, hints right.
  static ToyCourse Courtyard();
};

struct ToyResult {
  std::vector<double> gate_offset;  // m, of each true gate's middle when its plane was crossed in order; −1: not
  std::vector<stack::StackEvent> events;
  stack::StackState state = stack::StackState::kInitialising;
  double duration = 0.0;           // s from the start of the course to the target (or the end)
  double length = 0.0;             // m flown in that time
  double smallest_clearance = 10;  // m to true obstacles
  base::Vec3 end_O = base::Vec3::Zero();
  bool unknown_entered = false;  // the vehicle's centre was in a cell never seen, after take-off

  int Count(const std::string& kind) const;
  std::string Log() const;
};

ToyResult Fly(const ToyCourse& course, std::uint64_t seed = 1);

}  // namespace alula::tests
