#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "stack/interface/command.h"
#include "stack/interface/measurement.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// A mount on the body with three axes: yaw about the body's z, then pitch (positive: down), then roll.
struct GimbalConfig {
  std::string name;
  base::Vec3 position = base::Vec3::Zero();  // of the point that does not move, in the body frame, m
  base::Vec3 start = base::Vec3::Zero();     // roll, pitch, yaw wanted at first, rad
  base::Vec3 low{-0.5, -0.5, -3.0};          // limits of roll, pitch, yaw, rad
  base::Vec3 high{0.5, 1.75, 3.0};
  double fastest = 3.5;                         // per axis, rad/s
  base::Duration lag = base::Milliseconds(60);  // time constant of each axis
  bool stabilised = false;                      // angles wanted count from the horizon; yaw from the body's heading
  double levelling_error = 0.0035;              // of a stabilised mount's own horizon, 1σ, rad (0.2 deg)
  base::Rate rate{50, 1};                       // of the encoders' readings
  double encoder_noise = 8.7e-4;                // 1σ, rad (0.05 deg)
};
void Describe(base::Description& d, GimbalConfig& c);

/// Each axis follows the angle wanted with a first-order lag, no faster than it can and no farther than its stops:
/// a' = clamp((a_wanted − a) / lag, ±fastest). A stabilised mount knows up but for an error drawn once.
class Gimbal {
 public:
  Gimbal(const GimbalConfig& config, std::uint64_t seed, const std::string& name);

  void Want(const stack::GimbalSetpoint& setpoint) { wanted_ = {setpoint.roll, setpoint.pitch, setpoint.yaw}; }
  /// Stands where it is wanted, without lag: the start of a run.
  void Settle(base::Time t, const vehicles::BodyState& state);
  void Step(base::Time t, const vehicles::BodyState& state, base::Duration dt);
  /// Pose X_BG at a time within the last quarter of a second; held at the ends.
  base::Transform At(base::Time t) const;
  stack::GimbalAngles Sample();

 private:
  base::Vec3 Target(const vehicles::BodyState& state) const;
  void Remember(base::Time t);

  GimbalConfig config_;
  base::RandomStream stream_;
  base::Vec3 tilt_;    // error of its own horizon, rotation vector, rad
  base::Vec3 wanted_;  // roll, pitch, yaw
  base::Vec3 angles_ = base::Vec3::Zero();
  std::deque<std::pair<base::Time, base::Vec3>> history_;
};

/// Rotation q_BG of roll, pitch and yaw (rad).
base::Quat GimbalRotation(const base::Vec3& angles);

}  // namespace alula::sim
