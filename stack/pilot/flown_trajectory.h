#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/time.h"
#include "stack/planning/trajectory.h"

namespace alula::stack::pilot {

/// The trajectory being flown, and the one that takes over from it at its start.
/// A route is planned from where the vehicle will be when it comes. So whatever else changes the trajectory (take-off,
/// a brake, a turn) drops the one that waits and makes every route asked for before out of date: the generation grows.
class FlownTrajectory {
 public:
  explicit FlownTrajectory(const planning::TrajectoryLimits& limits) : limits_(limits) {}

  /// Flies this one at once.
  void Replace(planning::Trajectory trajectory);
  /// Brakes from a state as hard as the limits allow, then hovers.
  void Brake(base::Time now, const planning::TrajectoryPoint& state);
  /// Stands where the trajectory is now and turns through the headings (rad, not wrapped), at most at `rate` (rad/s).
  void Turn(base::Time now, const std::vector<double>& headings, double rate);
  /// A route's trajectory: waits for its start, which the present one leads to.
  void Queue(planning::Trajectory trajectory) { next_ = std::move(trajectory); }
  /// Lets a waiting trajectory take over when its time has come.
  void TakeOver(base::Time now);

  bool flying() const { return current_.has_value(); }
  bool waiting() const { return next_.has_value(); }
  /// A turn is being flown and not over.
  bool Turning(base::Time now) const { return turning_ && now < current_->yaw_end(); }
  /// What is being flown; throws before the first Replace.
  const planning::Trajectory& current() const { return current_.value(); }
  planning::TrajectoryPoint Sample(base::Time t) const { return current().Sample(t); }
  std::uint64_t generation() const { return generation_; }

 private:
  planning::TrajectoryLimits limits_;
  std::optional<planning::Trajectory> current_;
  std::optional<planning::Trajectory> next_;
  bool turning_ = false;  // current_ is a turn
  std::uint64_t generation_ = 0;
};

}  // namespace alula::stack::pilot
