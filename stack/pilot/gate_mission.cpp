#include "stack/pilot/gate_mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace alula::stack::pilot {

using base::Duration;
using base::Time;
using base::Transform;
using base::Vec3;
using planning::Trajectory;
using planning::TrajectoryPoint;

namespace {

constexpr Duration kArmPeriod = base::Milliseconds(500);  // between two tries to arm, or to land
constexpr Duration kClimbRest = base::Milliseconds(200);  // after the climb before the scan
constexpr double kClimbAcceleration = 1.5;                // m/s², at most
constexpr double kClimbTolerance = 0.1;                   // m below the take-off height that will do
constexpr double kScanBeyond = 0.4;                       // rad beyond the first gate
constexpr double kColumnRadius = 0.3;                     // m, the least

}  // namespace

GateMission::GateMission(const Calibration& calibration, const Mission& mission, const GateMissionConfig& config,
                         const planning::RouteConfig& route, const MapAlignmentConfig& alignment, Duration plan_latency,
                         std::uint64_t seed)
    : calibration_(calibration),
      config_(config),
      limits_(route.limits),
      column_radius_(std::max(mission.takeoff_column_radius, kColumnRadius)),
      flown_(route.limits),
      course_(mission, config, route, alignment, plan_latency, seed) {}

void GateMission::OnMap(std::shared_ptr<const mapping::ClearanceField> field,
                        const std::vector<std::optional<perception::GateObservation>>& gates) {
  course_.OnMap(std::move(field), gates);
  ++revision_;
}

void GateMission::OnRoute(planning::RouteResult result) {
  if (!course_.OnRoute(result, flown_)) return;
  path_O_ = std::move(result.path_O);
  ++revision_;
}

MissionOutput GateMission::Update(const MissionInput& input) {
  MissionOutput output;
  flown_.TakeOver(input.now);
  Proceed(input, output);
  SendSetpoint(input, output);
  return output;
}

std::vector<Transform> GateMission::gates_O() const {
  const GateBook& book = course_.book();
  std::vector<Transform> gates;
  for (int i = 0; i < book.size(); ++i) {
    if (book.Measured(i)) gates.push_back(book.X_OG(i));
  }
  return gates;
}

void GateMission::Proceed(const MissionInput& in, MissionOutput& out) {
  if (phase_ != Phase::kInitialising && phase_ != Phase::kArming && phase_ != Phase::kEnded) {
    if (!in.status.armed) {
      Fail(in.now, "disarmed", "the autopilot disarmed in flight", out);
      return;
    }
    if (!CheckOdometry(in, out)) return;
  }
  switch (phase_) {
    case Phase::kInitialising:
      WaitForOdometry(in, out);
      return;
    case Phase::kArming:
      Arming(in, out);
      return;
    case Phase::kClimb:
      if (in.now >= flown_.current().end() + kClimbRest) ClimbOnOrScan(in.now, out);
      return;
    case Phase::kScan:
      if (in.now >= flown_.current().yaw_end()) BeginCourse(in.now, out);
      return;
    case Phase::kCourse:
      if (!course_.Update(in, flown_, out)) return;
      phase_ = Phase::kArrived;
      state_ = StackState::kDone;
      Say(out, in.now, "arrived", "hovering at the target");
      return;
    case Phase::kArrived:
    case Phase::kLost:
    case Phase::kEnded:
      return;
  }
}

void GateMission::WaitForOdometry(const MissionInput& in, MissionOutput& out) {
  if (!in.initialised || !in.healthy || !in.status_known || !in.status.ready_to_arm) return;
  phase_ = Phase::kArming;
  state_ = StackState::kReady;
  Say(out, in.now, "ready", "odometry runs and the autopilot is ready: arming");
}

void GateMission::Arming(const MissionInput& in, MissionOutput& out) {
  if (in.status.armed) {
    TakeOff(in, out);
  } else if (in.now >= next_arm_) {
    next_arm_ = in.now + kArmPeriod;
    Send(in.now, Arm{}, out);
  }
}

void GateMission::TakeOff(const MissionInput& in, MissionOutput& out) {
  phase_ = Phase::kClimb;
  state_ = StackState::kFlying;
  takeoff_O_ = in.X_OB.p;
  Climb(in.now, {.p_O = in.X_OB.p, .yaw = base::Yaw(in.X_OB.q)});
  Say(out, in.now, "take_off", fmt::format("climbing {:.1f} m in the trusted column", config_.takeoff_height));
}

/// From rest at `here` up to the take-off height.
void GateMission::Climb(Time now, const TrajectoryPoint& here) {
  planning::TrajectoryLimits limits = limits_;
  limits.max_climb_speed = config_.takeoff_speed;
  limits.max_acceleration = std::min(limits.max_acceleration, kClimbAcceleration);
  const planning::Curve up({here.p_O, {here.p_O.x(), here.p_O.y(), takeoff_O_.z() + config_.takeoff_height}});
  flown_.Replace(Trajectory::Along(now, here, up, {}, limits).value());
  path_O_ = {up.Position(0), up.Position(up.length())};
  ++revision_;
}

/// A loss of the odometry may have ended the climb, or the scan, half-way.
void GateMission::ClimbOnOrScan(Time now, MissionOutput& out) {
  const TrajectoryPoint here = flown_.Sample(now);
  if (here.p_O.z() < takeoff_O_.z() + config_.takeoff_height - kClimbTolerance) {
    Climb(now, {.p_O = here.p_O, .yaw = here.yaw});
  } else {
    BeginScan(now, out);
  }
}

/// Looks to both sides, the first gate's last and farther than it is, and ends facing the first gate.
void GateMission::BeginScan(Time now, MissionOutput& out) {
  phase_ = Phase::kScan;
  const TrajectoryPoint here = flown_.Sample(now);
  double towards = 0.0;
  if (course_.book().size() > 0) {
    const Vec3 d = course_.book().X_OG(0).p - here.p_O;
    towards = base::WrapAngle(std::atan2(d.y(), d.x()) - here.yaw);
  }
  const double side = towards >= 0.0 ? 1.0 : -1.0;
  const double far = std::max(config_.scan_half_angle, std::abs(towards) + kScanBeyond);
  flown_.Turn(now, {here.yaw - side * config_.scan_half_angle, here.yaw + side * far, here.yaw + towards},
              config_.scan_rate);
  Say(out, now, "scan", fmt::format("looking around {:.1f} m up before the course", here.p_O.z() - takeoff_O_.z()));
}

void GateMission::BeginCourse(Time now, MissionOutput& out) {
  phase_ = Phase::kCourse;
  const planning::FreeZone column{takeoff_O_, takeoff_O_ + Vec3(0, 0, config_.takeoff_height), column_radius_};
  course_.Begin(now, column, takeoff_O_.z() - calibration_.standing_height);
  Say(out, now, "course", fmt::format("{} gates ahead", course_.book().size()));
}

/// False while nothing but waiting, or landing, is left to do.
bool GateMission::CheckOdometry(const MissionInput& in, MissionOutput& out) {
  if (in.healthy) {
    if (phase_ == Phase::kLost) {
      phase_ = phase_before_loss_;
      Say(out, in.now, "odometry_back", "the odometry is healthy again: starting over from a hover");
      flown_.Brake(in.now, {.p_O = in.X_OB.p, .v_O = in.v_OB, .yaw = base::Yaw(in.X_OB.q)});
    }
    return true;
  }
  if (phase_ != Phase::kLost) {
    phase_before_loss_ = phase_ == Phase::kScan ? Phase::kClimb : phase_;
    phase_ = Phase::kLost;
    lost_since_ = in.now;
    Say(out, in.now, "odometry_lost", "the odometry is not healthy: holding");
    Send(in.now, Hold{}, out);
  } else if (in.now - lost_since_ > config_.lost_time) {
    Fail(in.now, "landing", "the odometry did not recover: landing here", out);
  } else if (in.now >= next_setpoint_) {
    next_setpoint_ = in.now + config_.setpoint_period;
    Send(in.now, Hold{}, out);
  }
  return false;
}

void GateMission::SendSetpoint(const MissionInput& in, MissionOutput& out) {
  if (in.now < next_setpoint_) return;
  const bool flying =
      phase_ == Phase::kClimb || phase_ == Phase::kScan || phase_ == Phase::kCourse || phase_ == Phase::kArrived;
  if (phase_ == Phase::kEnded && in.status.armed) {
    next_setpoint_ = in.now + kArmPeriod;
    Send(in.now, Land{}, out);
  } else if (flying && flown_.flying()) {
    next_setpoint_ = in.now + config_.setpoint_period;
    const TrajectoryPoint point = flown_.Sample(in.now);
    Send(in.now, PositionSetpoint{point.p_O, point.v_O, point.a_O, base::WrapAngle(point.yaw), point.yaw_rate}, out);
  }
}

void GateMission::Fail(Time now, const std::string& kind, const std::string& text, MissionOutput& out) {
  phase_ = Phase::kEnded;
  state_ = StackState::kFailed;
  next_setpoint_ = now;
  Say(out, now, kind, text);
}

void GateMission::Send(Time now, decltype(Command::what) what, MissionOutput& out) const {
  out.commands.push_back({std::move(what), now, now + config_.command_lifetime});
}

}  // namespace alula::stack::pilot
