#include "vehicles/multicopter_mixer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace alula::vehicles {

MulticopterMixer::MulticopterMixer(const std::array<RotorMount, kRotors>& rotors, double torque_ratio) {
  for (int i = 0; i < kRotors; ++i) {
    const RotorMount& r = rotors[static_cast<std::size_t>(i)];
    effectiveness_.col(i) << 1.0, r.p_BR.y(), -r.p_BR.x(), -r.spin * torque_ratio;
  }
  const Eigen::FullPivLU<Eigen::Matrix4d> lu(effectiveness_);
  if (!lu.isInvertible()) throw base::InputError("the rotors cannot give torque about every axis");
  allocation_ = lu.inverse();
}

MulticopterMixer::Result MulticopterMixer::Mix(double collective, const base::Vec3& torque_B, double minimum,
                                               double maximum) const {
  Result result;
  const Thrusts lift = allocation_.col(0) * collective;
  Thrusts tilt = allocation_.col(1) * torque_B.x() + allocation_.col(2) * torque_B.y();

  const double span = tilt.maxCoeff() - tilt.minCoeff();
  if (span > maximum - minimum) {
    tilt *= (maximum - minimum) / span;
    for (int i = 0; i < 2; ++i) result.saturated[i] = torque_B[i] > 0 ? 1.0 : (torque_B[i] < 0 ? -1.0 : 0.0);
  }
  Thrusts thrusts = lift + tilt;
  if (thrusts.minCoeff() < minimum) thrusts.array() += minimum - thrusts.minCoeff();
  if (thrusts.maxCoeff() > maximum) thrusts.array() -= thrusts.maxCoeff() - maximum;

  const Thrusts twist = allocation_.col(3) * torque_B.z();
  double share = 1.0;
  for (int i = 0; i < kRotors; ++i) {
    const double room = twist[i] > 0 ? maximum - thrusts[i] : thrusts[i] - minimum;
    if (std::abs(twist[i]) > room) share = std::min(share, std::max(0.0, room) / std::abs(twist[i]));
  }
  if (share < 1.0) result.saturated.z() = torque_B.z() > 0 ? 1.0 : -1.0;
  result.thrusts = (thrusts + share * twist).cwiseMax(minimum).cwiseMin(maximum);
  result.collective = result.thrusts.sum();
  return result;
}

}  // namespace alula::vehicles
