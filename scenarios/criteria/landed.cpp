#include "scenarios/criteria/landed.h"

#include <algorithm>

namespace alula::scenarios {

void Describe(base::Description& d, LandedConfig& c) {
  d.Field("airborne_height", c.airborne_height, {.unit = "m", .meaning = "above the pad, counts as having flown"});
  d.Field("rest_speed", c.rest_speed, {.unit = "m/s", .meaning = "slower than this is at rest", .min = 0});
  d.Field("rest", c.rest, {.unit = "s", .meaning = "for this long"});
  d.Field("ends_run", c.ends_run, {.meaning = "whether the landing ends the run"});
}

std::optional<std::string> Landed::Observe(const sim::StepView& step) {
  const vehicles::BodyState& now = step.truth.at_end;
  const base::Vec3 from_start = now.X_WB.p - step.world.X_WB_start.p;
  if (from_start.z() - step.vehicle.body().standing_height > config_.airborne_height) flew_ = true;
  if (!flew_ || landed_) return std::nullopt;
  offset_ = from_start.head<2>().norm();
  const bool on_pad = std::any_of(step.contacts.begin(), step.contacts.end(), [&](const sim::Contact& contact) {
    return contact.may_touch && contact.object == step.world.pad_object;
  });
  const bool resting = on_pad && now.v_WB.norm() < config_.rest_speed && !step.status.armed;
  if (!resting) since_.reset();
  if (resting && !since_) since_ = step.time;
  landed_ = resting && step.time - *since_ >= config_.rest;
  if (landed_ && config_.ends_run) return "landed";
  return std::nullopt;
}

}  // namespace alula::scenarios
