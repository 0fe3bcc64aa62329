#include "scenarios/criteria/hover_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace alula::scenarios {

void Describe(base::Description& d, HoverErrorConfig& c) {
  d.Field("point", c.point, {.unit = "m", .meaning = "to be held, from where the body stood at the start"});
  d.Field("arrival_radius", c.arrival_radius, {.unit = "m", .meaning = "nearer than this is arrived", .min = 0});
  d.Field("settle", c.settle, {.unit = "s", .meaning = "from arrival to the window"});
  d.Field("window", c.window, {.unit = "s", .meaning = "over which the error is measured"});
  d.Field("rms", c.rms, {.unit = "m", .meaning = "limit of the root mean square error", .min = 0});
  d.Field("largest", c.largest, {.unit = "m", .meaning = "limit of the largest error", .min = 0});
}

std::optional<std::string> HoverError::Observe(const sim::StepView& step) {
  const base::Vec3 point_W =
      step.world.X_WB_start.p + config_.point + base::Vec3(0.0, 0.0, step.vehicle.body().standing_height);
  const double error = (step.truth.at_end.X_WB.p - point_W).norm();
  if (!arrived_ && error < config_.arrival_radius) arrived_ = step.time;
  if (!arrived_ || complete_ || step.time < *arrived_ + config_.settle) return std::nullopt;
  sum_squares_ += error * error;
  largest_ = std::max(largest_, error);
  ++samples_;
  complete_ = step.time >= *arrived_ + config_.settle + config_.window;
  return std::nullopt;
}

std::vector<Check> HoverError::Checks() const {
  // A window that was never filled has no error to speak of: it fails.
  const double none = std::numeric_limits<double>::infinity();
  const double rms = complete_ ? std::sqrt(sum_squares_ / static_cast<double>(samples_)) : none;
  return {AtMost("hover_rms_error", rms, config_.rms, "m"),
          AtMost("hover_largest_error", complete_ ? largest_ : none, config_.largest, "m")};
}

}  // namespace alula::scenarios
