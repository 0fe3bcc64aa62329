#include "worlds/kit/catenary.h"

#include <cmath>

#include "base/error.h"

namespace alula::worlds {

using base::Vec3;

Catenary::Catenary(const Vec3& from, const Vec3& to, double a) : from_(from), a_(a) {
  const Vec3 level(to.x() - from.x(), to.y() - from.y(), 0.0);
  span_ = level.norm();
  if (!(span_ > 0.0) || !(a > 0.0)) throw base::FaultError("world_setup", "a catenary needs a span and a tension");
  level_ = level / span_;
  rise_ = to.z() - from.z();
  lowest_ = 0.5 * span_ - a * std::asinh(rise_ / (2.0 * a * std::sinh(span_ / (2.0 * a))));
}

Vec3 Catenary::At(double share) const {
  const double x = share * span_;
  const double z = a_ * (std::cosh((x - lowest_) / a_) - std::cosh(lowest_ / a_));
  return from_ + x * level_ + Vec3(0.0, 0.0, z);
}

double Catenary::Length() const { return a_ * (std::sinh((span_ - lowest_) / a_) + std::sinh(lowest_ / a_)); }

double Catenary::Sag() const {
  const double x = lowest_ + a_ * std::asinh(rise_ / span_);  // where the slope is that of the straight line
  return rise_ * x / span_ - a_ * (std::cosh((x - lowest_) / a_) - std::cosh(lowest_ / a_));
}

}  // namespace alula::worlds
