#include "vehicles/flight_modes.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

using base::Time;
using base::Vec3;

namespace {
constexpr double kCarriedOn = 0.1;          // s that a set-point is extrapolated at most
constexpr double kTakeoffStep = 0.15;       // m above the vehicle that a set-point must be to start the climb
constexpr double kTakeoffSpeed = 0.1;       // m/s, the same for a velocity
constexpr double kDescentAcceleration = 1;  // m/s²
constexpr double kLargestJerk = 12;         // m/s³; more is a change of plan, not a trajectory

/// Jerk from the accelerations of two successive position set-points that lie close in time; zero otherwise.
Vec3 JerkBetween(const std::optional<stack::Command>& before, const stack::Command& after) {
  const auto* a = before ? std::get_if<stack::PositionSetpoint>(&before->what) : nullptr;
  const auto* b = std::get_if<stack::PositionSetpoint>(&after.what);
  if (!a || !b) return Vec3::Zero();
  const double dt = (after.issued - before->issued).Seconds();
  if (dt <= 0 || dt > kCarriedOn) return Vec3::Zero();
  const Vec3 jerk = (b->a_OB - a->a_OB) / dt;
  return jerk.norm() <= kLargestJerk ? jerk : Vec3::Zero();
}
}  // namespace

void Describe(base::Description& d, FailsafeConfig& c) {
  d.Field("estimate_timeout", c.estimate_timeout,
          {.unit = "s", .meaning = "without an estimate for so long the position is not trusted"});
  d.Field("hold_time", c.hold_time, {.unit = "s", .meaning = "silence is held for so long, then the vehicle lands"});
  d.Field("ready_timeout", c.ready_timeout, {.unit = "s", .meaning = "armed on the ground for so long: disarm"});
  d.Field("braking", c.braking, {.unit = "m/s^2", .meaning = "deceleration to a hold", .min = 0.1, .max = 10});
  d.Field("descent_speed", c.descent_speed, {.unit = "m/s", .meaning = "of a landing", .min = 0.1, .max = 5});
  d.Field("touchdown_speed", c.touchdown_speed, {.unit = "m/s", .meaning = "near the ground", .min = 0.1, .max = 2});
  d.Field("touchdown_height", c.touchdown_height,
          {.unit = "m", .meaning = "height above the take-off level that counts as near the ground", .min = 0});
}

void FlightModes::Receive(const stack::Command& command) {
  if (std::holds_alternative<stack::Arm>(command.what)) {
    arm_until_ = command.expires;
  } else if (std::holds_alternative<stack::Disarm>(command.what)) {
    disarm_ = true;
  } else {
    const std::optional<stack::Command> before = motion_;
    motion_ = command;
    fresh_ = true;
    jerk_ = JerkBetween(before, command);
  }
}

FlightGoal FlightModes::Step(const FlightSituation& s, double dt) {
  SwitchArming(s);
  SwitchFlight(s);
  fresh_ = false;

  FlightGoal goal;
  goal.armed = mode_ != Mode::kDisarmed;
  goal.fly = mode_ == Mode::kFollowing || mode_ == Mode::kHolding || mode_ == Mode::kLanding;
  if (mode_ == Mode::kFollowing) goal.setpoint = Followed(s.now);
  if (mode_ == Mode::kHolding) goal.setpoint = Held(s, dt);
  if (mode_ == Mode::kLanding) {
    goal.setpoint = Descent(s, dt);
    goal.descending = true;
    goal.level = !s.position_trusted;
  }
  // A stack that flies its set-points into the ground has landed too.
  if (mode_ == Mode::kFollowing && goal.setpoint.p_OB.z() < s.p_OB.z() - kTakeoffStep) goal.descending = true;
  return goal;
}

void FlightModes::SwitchArming(const FlightSituation& s) {
  if (mode_ == Mode::kDisarmed) {
    disarm_ = false;
    if (arm_until_ && s.now > *arm_until_) arm_until_.reset();
    if (arm_until_ && s.ready_to_arm) {
      arm_until_.reset();
      takeoff_height_ = s.p_OB.z();
      Enter(Mode::kReady, s);
    }
    return;
  }
  arm_until_.reset();
  const bool waited = mode_ == Mode::kReady && s.now - entered_ > config_.ready_timeout;
  const bool down = mode_ == Mode::kLanding && s.landed;
  if ((disarm_ && s.landed) || waited || down) {
    motion_.reset();
    Enter(Mode::kDisarmed, s);
  }
  disarm_ = false;  // in the air it is refused
}

bool FlightModes::WantsUp(const FlightSituation& s) const {
  if (const auto* p = std::get_if<stack::PositionSetpoint>(&motion_->what)) {
    return p->p_OB.z() > s.p_OB.z() + kTakeoffStep || p->v_OB.z() > kTakeoffSpeed;
  }
  const auto* v = std::get_if<stack::VelocitySetpoint>(&motion_->what);
  return v && v->v_OB.z() > kTakeoffSpeed;
}

void FlightModes::SwitchFlight(const FlightSituation& s) {
  if (mode_ == Mode::kDisarmed) return;
  const bool spoken = motion_ && s.now <= motion_->expires;
  const bool lands = motion_ && std::holds_alternative<stack::Land>(motion_->what);
  const bool holds = motion_ && std::holds_alternative<stack::Hold>(motion_->what);
  if (mode_ == Mode::kReady) {
    if (spoken && lands) Enter(Mode::kDisarmed, s);
    if (spoken && !lands && !holds && s.position_trusted && WantsUp(s)) Enter(Mode::kFollowing, s);
    return;
  }
  if (lands && (fresh_ || mode_ == Mode::kLanding)) {  // a landing goes on until something else is commanded
    if (mode_ != Mode::kLanding) Enter(Mode::kLanding, s);
    return;
  }
  if (spoken && !holds && s.position_trusted) {
    if (mode_ != Mode::kFollowing && fresh_) Enter(Mode::kFollowing, s);
    if (mode_ == Mode::kFollowing) {
      if (s.landed) Enter(Mode::kReady, s);
      return;
    }
  }
  if (mode_ == Mode::kFollowing || (mode_ == Mode::kLanding && fresh_ && holds)) {
    Enter(Mode::kHolding, s);
    silent_since_ = s.now;
  }
  if (mode_ == Mode::kHolding) {
    if (spoken && s.position_trusted) silent_since_ = s.now;
    if (s.now - silent_since_ > config_.hold_time) Enter(Mode::kLanding, s);
  }
}

void FlightModes::Enter(Mode mode, const FlightSituation& s) {
  const bool held_before = mode_ == Mode::kHolding;
  mode_ = mode;
  entered_ = s.now;
  descent_ = 0;
  if (mode == Mode::kHolding || (mode == Mode::kLanding && !held_before)) {
    held_ = MotionSetpoint{.p_OB = s.p_OB, .v_OB = s.v_OB, .yaw = s.yaw};
  }
}

MotionSetpoint FlightModes::Followed(Time now) const {
  const double dt = std::clamp((now - motion_->issued).Seconds(), 0.0, kCarriedOn);
  MotionSetpoint m;
  if (const auto* p = std::get_if<stack::PositionSetpoint>(&motion_->what)) {
    m.p_OB = p->p_OB + dt * (p->v_OB + 0.5 * dt * p->a_OB);
    m.v_OB = p->v_OB + dt * p->a_OB;
    m.a_OB = p->a_OB;
    m.jerk_OB = jerk_;
    m.yaw = p->yaw + dt * p->yaw_rate;
    m.yaw_rate = p->yaw_rate;
  } else if (const auto* v = std::get_if<stack::VelocitySetpoint>(&motion_->what)) {
    m.v_OB = v->v_OB;
    m.yaw = v->yaw + dt * v->yaw_rate;
    m.yaw_rate = v->yaw_rate;
    m.position_weight.setZero();
  }
  return m;
}

/// The held point runs out with constant deceleration and stays where it stops.
void FlightModes::Brake(double dt) {
  const double speed = held_.v_OB.norm();
  const double slower = std::max(0.0, speed - config_.braking * dt);
  held_.a_OB = speed > 0 && slower > 0 ? Vec3(-config_.braking / speed * held_.v_OB) : Vec3::Zero();
  const Vec3 v = speed > 0 ? Vec3(held_.v_OB * (slower / speed)) : Vec3::Zero();
  held_.p_OB += 0.5 * dt * (held_.v_OB + v);
  held_.v_OB = v;
}

MotionSetpoint FlightModes::Held(const FlightSituation& s, double dt) {
  Brake(dt);
  // Without estimates only the velocity is worth something, for as long as dead reckoning carries.
  if (!s.position_trusted) held_.p_OB.head<2>() = s.p_OB.head<2>();
  return held_;
}

MotionSetpoint FlightModes::Descent(const FlightSituation& s, double dt) {
  const double height = s.p_OB.z() - takeoff_height_;
  const double wanted = height > config_.touchdown_height ? config_.descent_speed : config_.touchdown_speed;
  descent_ += std::clamp(wanted - descent_, -kDescentAcceleration * dt, kDescentAcceleration * dt);
  MotionSetpoint m = Held(s, dt);
  m.v_OB.z() = -descent_;
  m.a_OB.z() = 0;
  m.position_weight.z() = 0;
  held_.p_OB.z() = s.p_OB.z();
  return m;
}

void FlightModes::Shift(const Vec3& position, double yaw) {
  held_.p_OB += position;
  held_.v_OB = base::FromYaw(yaw) * held_.v_OB;
  held_.yaw = base::WrapAngle(held_.yaw + yaw);
  takeoff_height_ += position.z();
}

}  // namespace alula::vehicles
