#include "worlds/wind.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace alula::worlds {

base::Vec3 GustAt(const CosineGust& gust, double t) {
  const double s = (t - gust.start) / gust.duration;
  if (s <= 0.0 || s >= 1.0) return base::Vec3::Zero();
  return 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * s)) * gust.velocity_W;
}

WindField::WindField(const Wind& wind, std::uint64_t seed)
    : wind_(wind),
      random_(seed, "wind"),
      gust_W_(wind.gust_sigma * random_.GaussianVec3()),
      dryden_random_(seed, "wind/dryden") {
  if (wind.gust_sigma < 0.0 || !(wind.gust_time > 0.0)) {
    throw base::InputError("wind: gust_sigma must not be negative and gust_time must be positive");
  }
  for (const CosineGust& gust : wind.gusts) {
    if (!(gust.duration > 0.0)) throw base::InputError("wind: a gust's duration must be positive");
  }
  if (!wind.dryden) return;
  if (wind.dryden->w20 < 0.0 || !(wind.dryden->airspeed_floor > 0.0)) {
    throw base::InputError("wind: w20 must not be negative and airspeed_floor must be positive");
  }
  dryden_.emplace(dryden_random_);
}

WindField::WindField(const World& world, std::uint64_t seed) : WindField(world.wind, seed) {
  if (world.wind.shelter) shelter_.emplace(world, world.wind.mean_W);
}

base::Vec3 WindField::Turbulence(const base::Vec3& p_W, base::Duration dt, const base::Vec3& v_W) {
  const base::Vec3 uvw = dryden_->Advance(*wind_.dryden, p_W.z(), (v_W - wind_.mean_W).norm(), dt, dryden_random_);
  const double speed = wind_.mean_W.head<2>().norm();
  const base::Vec2 along = speed > 0.0 ? base::Vec2(wind_.mean_W.head<2>() / speed) : base::Vec2(1.0, 0.0);
  return {along.x() * uvw.x() - along.y() * uvw.y(), along.y() * uvw.x() + along.x() * uvw.y(), uvw.z()};
}

base::Vec3 WindField::At(const base::Vec3& p_W, base::Duration dt, const base::Vec3& v_W) {
  constexpr base::Duration kLookUp = base::Milliseconds(10);
  if (dt != step_) {
    step_ = dt;
    decay_ = std::exp(-dt.Seconds() / wind_.gust_time);
    drive_ = wind_.gust_sigma * std::sqrt(1.0 - decay_ * decay_);
  }
  if (wind_.gust_sigma > 0.0 && dt.ns > 0) gust_W_ = decay_ * gust_W_ + drive_ * random_.GaussianVec3();
  time_ += dt;
  base::Vec3 air_W = wind_.mean_W + gust_W_;
  if (dryden_) air_W += Turbulence(p_W, dt, v_W);
  for (const CosineGust& gust : wind_.gusts) air_W += GustAt(gust, time_.Seconds());
  if (!shelter_) return air_W;
  if (time_ - looked_up_ >= kLookUp) {
    looked_up_ = time_;
    through_ = shelter_->Through(p_W);
  }
  return through_ * air_W;
}

}  // namespace alula::worlds
