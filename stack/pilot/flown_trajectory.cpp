#include "stack/pilot/flown_trajectory.h"

#include <utility>

namespace alula::stack::pilot {

using planning::Trajectory;
using planning::TrajectoryPoint;

void FlownTrajectory::Replace(Trajectory trajectory) {
  current_ = std::move(trajectory);
  next_.reset();
  turning_ = false;
  ++generation_;
}

void FlownTrajectory::Brake(base::Time now, const TrajectoryPoint& state) {
  Replace(Trajectory::Brake(now, state, limits_));
}

void FlownTrajectory::Turn(base::Time now, const std::vector<double>& headings, double rate) {
  const TrajectoryPoint here = Sample(now);
  Replace(Trajectory::Turn(now, here.p_O, here.yaw, headings, rate, limits_));
  turning_ = true;
}

void FlownTrajectory::TakeOver(base::Time now) {
  if (!next_ || now < next_->start()) return;
  current_ = std::move(next_);
  next_.reset();
  turning_ = false;
}

}  // namespace alula::stack::pilot
