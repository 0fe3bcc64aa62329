#include "sim/sensors/position_reference.h"

namespace alula::sim {

void Describe(base::Description& d, PositionReferenceConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("position_noise", c.position_noise, {.unit = "m", .meaning = "standard deviation per axis", .min = 0});
  d.Field("attitude_noise", c.attitude_noise, {.unit = "rad", .meaning = "standard deviation per axis", .min = 0});
  d.Field("delay", c.delay, {.unit = "s", .meaning = "from the measured instant to the stack"});
}

PositionReference::PositionReference(const PositionReferenceConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config), stream_(seed, name) {}

stack::PositionFix PositionReference::Sample(const base::Transform& X_WB) {
  const base::Vec3 dp = config_.position_noise * stream_.GaussianVec3();
  const base::Vec3 dtheta = config_.attitude_noise * stream_.GaussianVec3();
  return {{(X_WB.q * base::Exp(dtheta)).normalized(), X_WB.p + dp}, config_.position_noise, config_.attitude_noise};
}

}  // namespace alula::sim
