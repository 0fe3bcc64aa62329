#include "vehicles/land_detector.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

namespace {
constexpr double kReliefTime = 0.5;  // s in which the collective is taken back on the ground
}

void Describe(base::Description& d, LandDetectorConfig& c) {
  d.Field("still_speed", c.still_speed,
          {.unit = "m/s", .meaning = "a commanded descent slower than this is held up by something", .min = 0});
  d.Field("still_time", c.still_time, {.unit = "s", .meaning = "for this long", .min = 0});
  d.Field("ground_share", c.ground_share,
          {.meaning = "share of the weight that the ground must carry to count as contact", .min = 0.05, .max = 1});
  d.Field("ground_time", c.ground_time, {.unit = "s", .meaning = "for this long", .min = 0});
  d.Field("landed_thrust", c.landed_thrust,
          {.meaning = "thrust over weight below which contact is a landing", .min = 0.05, .max = 1});
  d.Field("landed_time", c.landed_time, {.unit = "s", .meaning = "for this long", .min = 0});
  d.Field("sinking_speed", c.sinking_speed, {.unit = "m/s", .meaning = "sinking faster ends a contact", .min = 0});
}

void LandDetector::SetLanded(bool landed) {
  landed_ = contact_ = landed;
  still_for_ = carried_for_ = low_for_ = 0;
  relief_ = landed ? 1 : 0;
}

void LandDetector::Step(bool descending, double thrust_share, double load_share, const base::Vec3& v_OB, double dt) {
  const auto time = [dt](bool holds, double& since) { since = holds ? since + dt : 0.0; };
  time(descending && std::abs(v_OB.z()) < config_.still_speed, still_for_);
  time(descending && load_share - thrust_share > config_.ground_share, carried_for_);
  if (still_for_ >= config_.still_time || carried_for_ >= config_.ground_time) contact_ = true;
  const bool falling = load_share < 0.6 && v_OB.z() < -config_.sinking_speed;  // nothing carries it
  if (!descending || falling) contact_ = false;

  relief_ = contact_ ? std::min(1.0, relief_ + dt / kReliefTime) : 0.0;
  time(contact_ && thrust_share < config_.landed_thrust, low_for_);
  landed_ = contact_ && low_for_ >= config_.landed_time;
}

}  // namespace alula::vehicles
