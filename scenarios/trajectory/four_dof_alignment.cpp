#include "scenarios/trajectory/four_dof_alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace alula::scenarios::trajectory {

void FourDofAlignment::Add(const base::Vec3& estimate, const base::Vec3& truth) {
  if (n_++ == 0) origin_ = truth;
  const base::Vec3 e = estimate - origin_, t = truth - origin_;
  e_ += e;
  t_ += t;
  et_ += e * t.transpose();
  ee_ += e.squaredNorm();
  tt_ += t.squaredNorm();
  difference_ += (e - t).squaredNorm();
}

FourDofAlignment::Centred FourDofAlignment::Centre() const {
  const double n = static_cast<double>(n_);
  const base::Mat3 et = et_ - e_ * t_.transpose() / n;
  return {ee_ - e_.squaredNorm() / n, tt_ - t_.squaredNorm() / n, et(0, 0) + et(1, 1), et(0, 1) - et(1, 0), et(2, 2)};
}

double FourDofAlignment::AlignedRmse() const {
  if (n_ == 0) return std::numeric_limits<double>::infinity();
  const Centred c = Centre();
  const double squares = c.tt + c.ee - 2.0 * (std::hypot(c.cos_sum, c.sin_sum) + c.zz);
  return std::sqrt(std::max(0.0, squares) / static_cast<double>(n_));
}

double FourDofAlignment::UnalignedRmse() const {
  if (n_ == 0) return std::numeric_limits<double>::infinity();
  return std::sqrt(difference_ / static_cast<double>(n_));
}

double FourDofAlignment::yaw() const {
  const Centred c = Centre();
  return std::atan2(c.sin_sum, c.cos_sum);
}

base::Transform FourDofAlignment::X_TE() const {
  if (n_ == 0) return {};
  const base::Quat q = base::FromYaw(yaw());
  const double n = static_cast<double>(n_);
  return {q, origin_ + t_ / n - q * base::Vec3(origin_ + e_ / n)};
}

}  // namespace alula::scenarios::trajectory
