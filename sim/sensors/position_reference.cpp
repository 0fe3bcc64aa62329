#include "sim/sensors/position_reference.h"

#include <cmath>

namespace alula::sim {

void Describe(base::Description& d, PositionReferenceConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("position_noise", c.position_noise, {.unit = "m", .meaning = "standard deviation per axis", .min = 0});
  d.Field("attitude_noise", c.attitude_noise, {.unit = "rad", .meaning = "standard deviation per axis", .min = 0});
  d.Field("delay", c.delay, {.unit = "s", .meaning = "from the measured instant to the stack"});
  d.Field("gnss", c.gnss, {.meaning = "satellites instead of motion capture: a wandering error, outages, no attitude"});
}

void Describe(base::Description& d, GnssReceiverConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("noise", c.noise, {.unit = "m", .meaning = "standard deviation per axis, from fix to fix", .min = 0});
  d.Field("delay", c.delay, {.unit = "s", .meaning = "from the measured instant to the stack"});
  Describe(d, static_cast<GnssConfig&>(c));
}

PositionReferenceConfig ReferenceOf(const GnssReceiverConfig& receiver) {
  return {.rate = receiver.rate,
          .position_noise = receiver.noise,
          .attitude_noise = 0.0,
          .delay = receiver.delay,
          .gnss = receiver};
}

PositionReference::PositionReference(const PositionReferenceConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config), stream_(seed, name) {
  if (config.gnss) gnss_.emplace(*config.gnss, config.rate.Period(), seed, name);
}

std::optional<stack::PositionFix> PositionReference::Sample(base::Time t, const base::Transform& X_WB) {
  const base::Vec3 dp = config_.position_noise * stream_.GaussianVec3();
  const base::Vec3 dtheta = config_.attitude_noise * stream_.GaussianVec3();
  if (!gnss_) {
    return stack::PositionFix{
        {(X_WB.q * base::Exp(dtheta)).normalized(), X_WB.p + dp}, config_.position_noise, config_.attitude_noise};
  }
  const std::optional<base::Vec3> error = gnss_->Next(t);
  if (!error) return std::nullopt;
  const GnssConfig& c = *config_.gnss;
  const double wandering = (2.0 * c.horizontal * c.horizontal + c.vertical * c.vertical) / 3.0;
  return stack::PositionFix{{base::Quat::Identity(), X_WB.p + dp + *error},
                            std::sqrt(config_.position_noise * config_.position_noise + wandering),
                            kUnmeasuredAttitude};
}

}  // namespace alula::sim
