#include "worlds/wind.h"

#include <cmath>

#include "base/error.h"

namespace alula::worlds {

WindField::WindField(const Wind& wind, std::uint64_t seed)
    : wind_(wind), random_(seed, "wind"), gust_W_(wind.gust_sigma * random_.GaussianVec3()) {
  if (wind.gust_sigma < 0.0 || !(wind.gust_time > 0.0)) {
    throw base::InputError("wind: gust_sigma must not be negative and gust_time must be positive");
  }
}

base::Vec3 WindField::At(const base::Vec3& /*p_W*/, base::Duration dt) {
  if (dt != step_) {
    step_ = dt;
    decay_ = std::exp(-dt.Seconds() / wind_.gust_time);
    drive_ = wind_.gust_sigma * std::sqrt(1.0 - decay_ * decay_);
  }
  if (wind_.gust_sigma > 0.0 && dt.ns > 0) gust_W_ = decay_ * gust_W_ + drive_ * random_.GaussianVec3();
  return wind_.mean_W + gust_W_;
}

}  // namespace alula::worlds
