#pragma once

#include "base/describe.h"
#include "base/frames.h"
#include "vehicles/low_pass.h"

namespace alula::vehicles {

struct AttitudeControlConfig {
  double attitude_gain = 10.0;                  // 1/s, roll and pitch
  double yaw_gain = 3.0;                        // 1/s
  double maximum_rate = 6.0;                    // rad/s, roll and pitch
  double maximum_yaw_rate = 2.5;                // rad/s
  base::Vec3 rate_gain{24, 24, 8};              // 1/s: angular acceleration per rate error
  base::Vec3 rate_integral{40, 40, 8};          // 1/s²
  base::Vec3 rate_derivative{0.25, 0.25, 0.0};  // of measured angular acceleration, pure number
  base::Vec3 maximum_integral{20, 20, 6};       // rad/s²
  double gyro_cutoff = 90.0;                    // Hz, low-pass of the gyro in the rate loop
  double derivative_cutoff = 40.0;              // Hz, low-pass of its derivative
  /// First-order low-pass of the yaw torque, Hz: the rotors' inertia already answers fast (a zero at 2 k_q ω / J_r,
  /// 0.9 Hz at hover), and this pole takes that zero's place (PX4's MC_YAW_TQ_CUTOFF).
  double yaw_torque_cutoff = 1.2;
};
void Describe(base::Description& d, AttitudeControlConfig& c);

/// The attitude whose z axis lies along f and whose heading is `yaw`.
base::Quat AttitudeFor(const base::Vec3& f_O, double yaw);

/// Body rates that turn q to q_sp: the shortest turn of the thrust axis first, heading weighted by
/// yaw_gain / attitude_gain, proportional to the sine of half the angle (Brescianini, Hehn and D'Andrea 2013, sections
/// 3–4, as PX4's AttitudeControl), plus the heading's rate. rad/s, limited.
base::Vec3 RateSetpoint(const AttitudeControlConfig& c, const base::Quat& q_OB, const base::Quat& q_OB_sp,
                        double yaw_rate);

/// PID on body rates: angular acceleration wanted = K (w_sp − w) + ∫ K_i (w_sp − w) − K_d dw/dt. The integral does not
/// grow on axes that the mixer reports as saturated in its direction.
class RateControl {
 public:
  RateControl(const AttitudeControlConfig& config, double sample_rate);

  /// `gyro`: unfiltered angular velocity less bias, rad/s. `saturated`: per axis −1, 0 or +1, from the mixer.
  /// Returns angular acceleration, rad/s².
  base::Vec3 Step(const base::Vec3& w_sp, const base::Vec3& gyro, const base::Vec3& saturated, bool integrate,
                  double dt);

  const base::Vec3& rate() const { return filtered_; }  // filtered, rad/s
  void Reset() {
    integral_.setZero();
    yaw_ = 0;
  }

 private:
  AttitudeControlConfig config_;
  LowPass gyro_filter_;
  LowPass derivative_filter_;
  base::Vec3 filtered_ = base::Vec3::Zero();
  base::Vec3 integral_ = base::Vec3::Zero();
  double yaw_ = 0.0;  // rad/s², after the yaw torque's low-pass
  bool started_ = false;
};

}  // namespace alula::vehicles
