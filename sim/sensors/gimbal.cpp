#include "sim/sensors/gimbal.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {
namespace {

constexpr base::Duration kMemory = base::Milliseconds(250);  // longer than any exposure

/// Roll, pitch and yaw of a rotation (z-y'-x'').
base::Vec3 AnglesOf(const base::Mat3& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace

void Describe(base::Description& d, GimbalConfig& c) {
  d.Field("name", c.name, {.meaning = "that cameras call it by", .required = true});
  d.Field("position", c.position, {.unit = "m", .meaning = "of the point that does not move, in the body frame"});
  d.Field("start", c.start, {.unit = "rad", .meaning = "roll, pitch (positive: down) and yaw wanted at first"});
  d.Field("low", c.low, {.unit = "rad", .meaning = "stops of roll, pitch and yaw", .min = -6.3, .max = 6.3});
  d.Field("high", c.high, {.unit = "rad", .meaning = "stops of roll, pitch and yaw", .min = -6.3, .max = 6.3});
  d.Field("fastest", c.fastest, {.unit = "rad/s", .meaning = "that an axis turns", .min = 0.01, .max = 100});
  d.Field("lag", c.lag, {.unit = "s", .meaning = "time constant of an axis", .min = 1e-3, .max = 10});
  d.Field("stabilised", c.stabilised, {.meaning = "holds the horizon; yaw counts from the body's heading"});
  d.Field("levelling_error", c.levelling_error,
          {.unit = "rad", .meaning = "of a stabilised mount's horizon, standard deviation", .min = 0, .max = 0.5});
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "of the encoders' readings"});
  d.Field("encoder_noise", c.encoder_noise, {.unit = "rad", .meaning = "standard deviation", .min = 0, .max = 0.5});
  d.Check("high", [&c] {
    return (c.low.array() > c.high.array()).any() ? std::string("is below low; must be at least that") : std::string();
  });
}

base::Quat GimbalRotation(const base::Vec3& angles) {
  return base::FromYawPitchRoll(angles.z(), angles.y(), angles.x());
}

Gimbal::Gimbal(const GimbalConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config), stream_(seed, name), wanted_(config.start) {
  tilt_ = config.levelling_error * base::Vec3(stream_.Gaussian(), stream_.Gaussian(), 0.0);
}

base::Vec3 Gimbal::Target(const vehicles::BodyState& state) const {
  base::Vec3 target = wanted_;
  if (config_.stabilised) {
    const base::Quat& q_WB = state.X_WB.q;
    const base::Quat q_WG = base::Exp(tilt_) * base::FromYaw(base::Yaw(q_WB)) * GimbalRotation(wanted_);
    target = AnglesOf((q_WB.conjugate() * q_WG).toRotationMatrix());
  }
  return target.cwiseMax(config_.low).cwiseMin(config_.high);
}

void Gimbal::Settle(base::Time t, const vehicles::BodyState& state) {
  angles_ = Target(state);
  history_.clear();
  Remember(t);
}

void Gimbal::Step(base::Time t, const vehicles::BodyState& state, base::Duration dt) {
  const base::Vec3 error = Target(state) - angles_;
  // The exact response of the lag over one step; the limit of speed caps it.
  const double share = 1.0 - std::exp(-dt.Seconds() / config_.lag.Seconds());
  const double most = config_.fastest * dt.Seconds();
  angles_ += (share * error).cwiseMax(-most).cwiseMin(most);
  angles_ = angles_.cwiseMax(config_.low).cwiseMin(config_.high);
  Remember(t);
}

void Gimbal::Remember(base::Time t) {
  history_.emplace_back(t, angles_);
  while (history_.size() > 2 && history_[1].first + kMemory < t) history_.pop_front();
}

base::Transform Gimbal::At(base::Time t) const {
  const auto later = std::lower_bound(history_.begin(), history_.end(), t,
                                      [](const auto& entry, base::Time time) { return entry.first < time; });
  base::Vec3 angles;
  if (later == history_.end()) {
    angles = history_.back().second;
  } else if (later == history_.begin()) {
    angles = later->second;
  } else {
    const auto before = std::prev(later);
    const double s = (t - before->first).Seconds() / (later->first - before->first).Seconds();
    angles = (1.0 - s) * before->second + s * later->second;
  }
  return {GimbalRotation(angles), config_.position};
}

stack::GimbalAngles Gimbal::Sample() {
  const base::Vec3 read = history_.back().second + config_.encoder_noise * stream_.GaussianVec3();
  return {read.x(), read.y(), read.z()};
}

}  // namespace alula::sim
