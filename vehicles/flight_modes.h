#pragma once

#include <optional>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/command.h"
#include "stack/interface/measurement.h"
#include "vehicles/position_control.h"

namespace alula::vehicles {

/// When the autopilot takes matters into its own hands.
struct FailsafeConfig {
  base::Duration estimate_timeout = base::Milliseconds(500);  // without an estimate: no longer trust the position
  base::Duration hold_time = base::Seconds(3.0);              // silence is held this long, then the vehicle lands
  base::Duration ready_timeout = base::Seconds(10.0);         // armed on the ground without a take-off: disarm
  double braking = 3.0;                                       // m/s², to a hold
  double descent_speed = 0.7;                                 // m/s
  double touchdown_speed = 0.3;                               // m/s, within touchdown_height of the take-off level
  double touchdown_height = 1.0;                              // m
};
void Describe(base::Description& d, FailsafeConfig& c);

/// What the modes are judged by.
struct FlightSituation {
  base::Time now;
  bool ready_to_arm = false;
  bool position_trusted = false;  // estimates arrive
  bool landed = true;
  base::Vec3 p_OB = base::Vec3::Zero();
  base::Vec3 v_OB = base::Vec3::Zero();
  double yaw = 0.0;
};

/// What the controllers are to do.
struct FlightGoal {
  bool armed = false;
  bool fly = false;         // otherwise the rotors idle or stand
  bool level = false;       // keep the thrust upright: the position is not known
  bool descending = false;  // a landing is under way
  MotionSetpoint setpoint;
};

/// The state machine of MakeMulticopterAutopilot (multicopter_autopilot.h draws it): from commands and their expiry to
/// a mode and a set-point. Between commands a set-point is carried on by its own velocity and acceleration for at most
/// 0.1 s from when it was issued.
class FlightModes {
 public:
  using Mode = stack::VehicleStatus::Mode;

  explicit FlightModes(const FailsafeConfig& config) : config_(config) {}

  void Receive(const stack::Command& command);
  FlightGoal Step(const FlightSituation& situation, double dt);
  /// The odometry frame was re-initialised: what is held moves with it.
  void Shift(const base::Vec3& position, double yaw);

  Mode mode() const { return mode_; }

 private:
  void SwitchArming(const FlightSituation& s);
  void SwitchFlight(const FlightSituation& s);
  void Enter(Mode mode, const FlightSituation& s);
  bool WantsUp(const FlightSituation& s) const;
  MotionSetpoint Followed(base::Time now) const;
  void Brake(double dt);
  MotionSetpoint Held(const FlightSituation& s, double dt);
  MotionSetpoint Descent(const FlightSituation& s, double dt);

  FailsafeConfig config_;
  Mode mode_ = Mode::kDisarmed;
  std::optional<base::Time> arm_until_;
  bool disarm_ = false;
  std::optional<stack::Command> motion_;  // the last command that moves: set-point, Hold or Land
  bool fresh_ = false;                    // it came after the last Step
  base::Vec3 jerk_ = base::Vec3::Zero();  // m/s³, from successive set-points
  base::Time entered_;                    // when the mode began
  base::Time silent_since_;
  double takeoff_height_ = 0;
  MotionSetpoint held_;
  double descent_ = 0;  // m/s, slewed
};

}  // namespace alula::vehicles
