#include "stack/estimation/static_initialiser.h"

#include <cmath>

namespace alula::stack::estimation {

using base::Quat;
using base::Vec3;

std::optional<StandstillState> FromStandstill(const std::vector<TimedImu>& samples, const Quat& q_BI, double yaw) {
  if (samples.empty()) return std::nullopt;
  Vec3 gyro = Vec3::Zero(), force = Vec3::Zero();
  for (const TimedImu& s : samples) {
    gyro += s.gyro;
    force += s.accel;
  }
  gyro /= static_cast<double>(samples.size());
  force /= static_cast<double>(samples.size());
  constexpr double kMaxRate = 0.2;  // rad/s: above any turn-on bias of this class
  if (std::abs(force.norm() / base::kGravity - 1.0) > 0.15 || gyro.norm() > kMaxRate) return std::nullopt;

  // The shortest turn that brings the measured up direction to z; then about z until the body looks along `yaw`.
  const Quat q_level = Quat::FromTwoVectors(force, Vec3::UnitZ());
  const double heading = base::Yaw(q_level * q_BI.conjugate());
  return StandstillState{(base::FromYaw(base::WrapAngle(yaw - heading)) * q_level).normalized(), gyro};
}

}  // namespace alula::stack::estimation
