#include "stack/pilot/flight_watch.h"

#include <cmath>

namespace alula::stack::pilot {

namespace {

constexpr double kRestRadius = 0.25;    // m within which it counts as at rest
constexpr double kRestYawRate = 0.15;   // rad/s
constexpr double kReactionTime = 0.45;  // s that a new route needs: map's turn and plan
constexpr double kHardlyMoves = 0.1;    // m/s

}  // namespace

void RestWatch::Update(base::Time now, const planning::TrajectoryPoint& setpoint) {
  if ((setpoint.p_O - at_O_).norm() > kRestRadius || std::abs(setpoint.yaw_rate) > kRestYawRate) {
    at_O_ = setpoint.p_O;
    since_ = now;
  }
}

bool TooLateToReplan(double time_to_block, double speed, double max_acceleration) {
  if (speed < kHardlyMoves) return false;
  const double time_to_stop = speed / max_acceleration;
  return time_to_block <= time_to_stop + kReactionTime;
}

bool MustBrake(const planning::Trajectory& trajectory, base::Time now, const planning::TrajectoryPoint& setpoint,
               const mapping::ClearanceField& field, const std::vector<planning::Passage>& passages,
               const planning::RouteConfig& config) {
  const auto blocked = planning::FirstBlocked(trajectory, now, field, passages, config);
  return blocked && TooLateToReplan((*blocked - now).Seconds(), setpoint.v_O.norm(), config.limits.max_acceleration);
}

}  // namespace alula::stack::pilot
