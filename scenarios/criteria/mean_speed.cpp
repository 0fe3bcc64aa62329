#include "scenarios/criteria/mean_speed.h"

#include <algorithm>

namespace alula::scenarios {

void Describe(base::Description& d, MeanSpeedConfig& c) {
  d.Field("least", c.least, {.unit = "m/s", .meaning = "least mean speed over the course", .min = 0});
  d.Field("target_radius", c.target_radius,
          {.unit = "m", .meaning = "the course ends this near to the target", .min = 0});
}

std::optional<std::string> MeanSpeed::Observe(const sim::StepView& step) {
  tracker_.Look(step);
  const vehicles::BodyState& now = step.truth.at_end;
  const double moved = (now.X_WB.p - step.truth.at_begin.X_WB.p).norm();
  path_ += moved;
  fastest_ = std::max(fastest_, now.v_WB.norm());
  const base::Vec3 from_start = now.X_WB.p - step.world.X_WB_start.p;
  if (!left_ && from_start.head<2>().norm() > step.world.pad_radius) left_ = step.time;
  if (!left_ || finished_) return std::nullopt;
  course_ += moved;
  last_ = step.time;
  finished_ = tracker_.done(step.world) && (now.X_WB.p - step.world.target).norm() <= config_.target_radius;
  return std::nullopt;
}

double MeanSpeed::Speed() const {
  const double time = left_ ? (last_ - *left_).Seconds() : 0.0;
  return time > 0.0 ? course_ / time : 0.0;
}

std::vector<Check> MeanSpeed::Checks() const { return {AtLeast("mean_speed", Speed(), config_.least, "m/s")}; }

void MeanSpeed::AddMetrics(Metrics& metrics) const {
  metrics["path_length_m"] = path_;
  metrics["course_length_m"] = course_;
  metrics["course_time_s"] = left_ ? (last_ - *left_).Seconds() : 0.0;
  metrics["mean_speed_m_s"] = Speed();
  metrics["top_speed_m_s"] = fastest_;
}

}  // namespace alula::scenarios
