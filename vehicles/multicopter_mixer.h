#pragma once

#include <Eigen/Core>
#include <array>

#include "base/frames.h"
#include "vehicles/quadrotor.h"

namespace alula::vehicles {

/// Splits collective thrust and torque among the rotors, and says what could not be had.
///
///   T_total = Σ T_i,   τ = Σ (p_i × z) T_i − spin_i (k_q / k_t) T_i z
///
/// Where a rotor saturates: the collective moves up or down first (roll and pitch keep their authority, also at idle),
/// then roll and pitch shrink together if their span is larger than a rotor's range, and yaw gets what room is left —
/// it is the first to be given up (PX4, ControlAllocationSequentialDesaturation, with air mode).
class MulticopterMixer {
 public:
  using Thrusts = Eigen::Vector4d;

  /// `torque_ratio`: k_q / k_t, m.
  MulticopterMixer(const std::array<RotorMount, kRotors>& rotors, double torque_ratio);

  struct Result {
    Thrusts thrusts = Thrusts::Zero();          // N
    base::Vec3 saturated = base::Vec3::Zero();  // −1, 0, +1 per axis: torque asked for beyond what was had
    double collective = 0.0;                    // N, as had
  };
  /// Thrusts within [minimum, maximum] N each for collective thrust (N) and torque (N·m, body axes).
  Result Mix(double collective, const base::Vec3& torque_B, double minimum, double maximum) const;

  /// Collective (N) and torque (N·m) that thrusts give.
  Eigen::Vector4d Wrench(const Thrusts& thrusts) const { return effectiveness_ * thrusts; }

 private:
  Eigen::Matrix4d effectiveness_;  // thrusts → (T, τ)
  Eigen::Matrix4d allocation_;     // its inverse
};

}  // namespace alula::vehicles
