#pragma once

#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/mapping/clearance_field.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

/// How long the set-point has been at rest: within a small radius and hardly turning.
class RestWatch {
 public:
  void Update(base::Time now, const planning::TrajectoryPoint& setpoint);
  /// Something was done about the rest: it counts from now.
  void Restart(base::Time now) { since_ = now; }
  base::Duration Rest(base::Time now) const { return now - since_; }

 private:
  base::Vec3 at_O_ = base::Vec3::Zero();
  base::Time since_;
};

/// Whether an obstacle `time_to_block` (s) ahead is too near for a new route, so that only braking is left:
///   time_to_block ≤ speed / max_acceleration + the time that a new route needs.
/// A vehicle that hardly moves need not brake.
bool TooLateToReplan(double time_to_block, double speed, double max_acceleration);

/// Whether the trajectory runs into something that the map shows, and no new route can come in time.
bool MustBrake(const planning::Trajectory& trajectory, base::Time now, const planning::TrajectoryPoint& setpoint,
               const mapping::ClearanceField& field, const std::vector<planning::Passage>& passages,
               const planning::RouteConfig& config);

}  // namespace alula::stack::pilot
