#include "scenarios/criteria/clearance.h"

namespace alula::scenarios {

void Describe(base::Description& d, ClearanceConfig& c) {
  d.Field("least", c.least, {.unit = "m", .meaning = "least distance allowed"});
  d.Field("airborne_height", c.airborne_height,
          {.unit = "m", .meaning = "above standing; lower is take-off or landing and does not count"});
  d.Field("reach", c.reach, {.unit = "m", .meaning = "farther is not measured", .min = 0});
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "of measuring"});
}

std::optional<std::string> Clearance::Observe(const sim::StepView& step) {
  if (config_.rate.SampleTime(next_) > step.time) return std::nullopt;
  while (config_.rate.SampleTime(next_) <= step.time) ++next_;
  const double height =
      step.truth.at_end.X_WB.p.z() - step.world.X_WB_start.p.z() - step.vehicle.body().standing_height;
  if (height > config_.airborne_height) smallest_ = step.physics.HullClearance(smallest_).distance;
  return std::nullopt;
}

}  // namespace alula::scenarios
