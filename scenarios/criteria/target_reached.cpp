#include "scenarios/criteria/target_reached.h"

namespace alula::scenarios {

void Describe(base::Description& d, TargetReachedConfig& c) {
  d.Field("radius", c.radius, {.unit = "m", .meaning = "as near as this", .min = 0});
  d.Field("speed", c.speed, {.unit = "m/s", .meaning = "and as slow as this", .min = 0});
  d.Field("dwell", c.dwell, {.unit = "s", .meaning = "for this long"});
  d.Field("ends_run", c.ends_run, {.meaning = "whether reaching the target ends the run"});
}

std::optional<std::string> TargetReached::Observe(const sim::StepView& step) {
  tracker_.Look(step);
  if (reached_) return std::nullopt;
  gates_done_ = tracker_.done(step.world);
  distance_ = (step.truth.at_end.X_WB.p - step.world.target).norm();
  const bool there = gates_done_ && distance_ <= config_.radius && step.truth.at_end.v_WB.norm() <= config_.speed;
  if (!there) since_.reset();
  if (there && !since_) since_ = step.time;
  reached_ = there && step.time - *since_ >= config_.dwell;
  if (reached_ && config_.ends_run) return "target_reached";
  return std::nullopt;
}

std::vector<Check> TargetReached::Checks() const {
  Check check = AtMost("target_distance", distance_, config_.radius, "m");
  check.passed = reached_;
  return {check};
}

}  // namespace alula::scenarios
