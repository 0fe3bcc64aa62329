#include "stack/pilot/position_relay_stack.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace alula::stack::pilot {

using base::Time;
using base::Vec3;
using planning::Trajectory;
using planning::TrajectoryLimits;

namespace {

constexpr base::Duration kArmPeriod = base::Milliseconds(500);

class PositionRelayStack : public NavigationStack {
 public:
  PositionRelayStack(const Calibration& calibration, const Mission& mission, const PositionRelayConfig& config)
      : calibration_(calibration), mission_(mission), config_(config) {
    if (!calibration.position_reference) {
      throw base::InputError("the position relay stack needs a position reference among the vehicle's sensors");
    }
  }

  StackOutput Step(Time now, std::span<const Measurement> measurements) override {
    StackOutput output;
    for (const Measurement& measurement : measurements) Take(measurement, output);
    Proceed(now, output);
    if (trajectory_ && phase_ == Phase::kFlying && now >= next_setpoint_) {
      next_setpoint_ = now + config_.setpoint_period;
      const planning::TrajectoryPoint point = trajectory_->Sample(now);
      Send(PositionSetpoint{point.p_O, point.v_O, point.a_O, point.yaw, point.yaw_rate}, now, output);
    }
    output.state = state_;
    return output;
  }

 private:
  enum class Phase { kWaiting, kArming, kFlying, kLanding, kDone };

  void Take(const Measurement& measurement, StackOutput& output) {
    if (const auto* status = std::get_if<VehicleStatus>(&measurement.data)) status_ = *status;
    const auto* fix = std::get_if<PositionFix>(&measurement.data);
    if (fix == nullptr || measurement.sensor != calibration_.position_reference->sensor) return;
    Estimate estimate;
    estimate.stamp = measurement.captured;
    estimate.X_OB = fix->X_WB;
    if (last_fix_) {
      const double dt = (measurement.captured - last_fix_time_).Seconds();
      if (dt <= 0.0) return;
      const double gain = 1.0 - std::exp(-dt / config_.velocity_time.Seconds());
      v_O_ += gain * ((fix->X_WB.p - last_fix_->p) / dt - v_O_);
    }
    estimate.v_OB = v_O_;
    estimate.pose_covariance.diagonal() << Vec3::Constant(fix->position_sigma * fix->position_sigma),
        Vec3::Constant(fix->attitude_sigma * fix->attitude_sigma);
    estimate.velocity_covariance = base::Mat3::Identity() * (config_.velocity_sigma * config_.velocity_sigma);
    last_fix_ = fix->X_WB;
    last_fix_time_ = measurement.captured;
    output.estimate = estimate;
  }

  void Proceed(Time now, StackOutput& output) {
    switch (phase_) {
      case Phase::kWaiting:
        if (!last_fix_ || !status_ || !status_->ready_to_arm) return;
        state_ = StackState::kReady;
        phase_ = Phase::kArming;
        Say(now, "arming", "the autopilot is ready and positions arrive", output);
        [[fallthrough]];
      case Phase::kArming:
        if (!status_->armed) {
          if (now < next_arm_) return;
          next_arm_ = now + kArmPeriod;
          Send(Arm{}, now, output);
          return;
        }
        TakeOff(now, output);
        return;
      case Phase::kFlying:
        if (!status_->armed) {
          Fail(now, "disarmed", "the autopilot disarmed in flight", output);
        } else if (now - last_fix_time_ > config_.fix_timeout) {
          Fail(now, "no_position", "no position has arrived for too long: landing", output);
        } else {
          Continue(now, output);
        }
        return;
      case Phase::kLanding:
        if (!status_->armed) {
          phase_ = Phase::kDone;
          if (state_ != StackState::kFailed) state_ = StackState::kDone;
          Say(now, "disarmed", "on the ground and disarmed", output);
        } else if (now >= next_setpoint_) {
          next_setpoint_ = now + kArmPeriod;
          Send(Land{}, now, output);
        }
        return;
      case Phase::kDone:
        return;
    }
  }

  void TakeOff(Time now, StackOutput& output) {
    phase_ = Phase::kFlying;
    state_ = StackState::kFlying;
    yaw_ = base::Yaw(last_fix_->q);
    trajectory_ = Trajectory::Hover(now, last_fix_->p, yaw_);
    Leg(now, last_fix_->p + Vec3(0, 0, config_.takeoff_height), config_.climb_speed);
    Say(now, "take_off", "climbing", output);
  }

  void Continue(Time now, StackOutput& output) {
    const bool still = now >= trajectory_->end() + config_.dwell;
    if (!still || (last_fix_->p - trajectory_->end_point()).norm() > config_.arrival_radius) return;
    if (next_waypoint_ < mission_.waypoints.size()) {
      Leg(now, mission_.waypoints[next_waypoint_], config_.cruise_speed);
      Say(now, "waypoint", "flying to waypoint " + std::to_string(next_waypoint_), output);
      ++next_waypoint_;
    } else {
      phase_ = Phase::kLanding;
      Say(now, "landing", "all waypoints visited", output);
    }
  }

  /// A straight leg from rest to rest, heading kept.
  void Leg(Time now, const Vec3& goal_O, double speed) {
    const planning::TrajectoryPoint from = trajectory_->Sample(now);
    if ((goal_O - from.p_O).norm() < 0.01) return;
    TrajectoryLimits limits;
    limits.max_speed = limits.max_climb_speed = speed;
    limits.max_acceleration = config_.max_acceleration;
    limits.yaw_look_ahead = 0.01;  // the heading stays
    const planning::Curve line({from.p_O, goal_O});
    if (auto leg = Trajectory::Along(now, from, line, {}, limits)) trajectory_ = std::move(leg);
  }

  void Fail(Time now, const std::string& kind, const std::string& text, StackOutput& output) {
    phase_ = Phase::kLanding;
    state_ = StackState::kFailed;
    Say(now, kind, text, output);
  }

  void Send(decltype(Command::what) what, Time now, StackOutput& output) const {
    output.commands.push_back({std::move(what), now, now + config_.command_lifetime});
  }

  static void Say(Time now, const std::string& kind, const std::string& text, StackOutput& output) {
    output.events.push_back({now, kind, text});
  }

  Calibration calibration_;
  Mission mission_;
  PositionRelayConfig config_;
  Phase phase_ = Phase::kWaiting;
  StackState state_ = StackState::kInitialising;
  std::optional<VehicleStatus> status_;
  std::optional<base::Transform> last_fix_;
  Time last_fix_time_;
  Vec3 v_O_ = Vec3::Zero();
  std::optional<Trajectory> trajectory_;
  double yaw_ = 0.0;
  std::size_t next_waypoint_ = 0;
  Time next_setpoint_;
  Time next_arm_;
};

}  // namespace

void Describe(base::Description& d, PositionRelayConfig& c) {
  d.Field("cruise_speed", c.cruise_speed, {.unit = "m/s", .meaning = "between waypoints", .min = 0.05, .max = 20});
  d.Field("max_acceleration", c.max_acceleration,
          {.unit = "m/s^2", .meaning = "of the set-points", .min = 0.05, .max = 20});
  d.Field("climb_speed", c.climb_speed, {.unit = "m/s", .meaning = "during take-off", .min = 0.05, .max = 10});
  d.Field("takeoff_height", c.takeoff_height,
          {.unit = "m", .meaning = "above the place of take-off", .min = 0.1, .max = 100});
  d.Field("arrival_radius", c.arrival_radius,
          {.unit = "m", .meaning = "a waypoint counts as reached when this near", .min = 0.01, .max = 10});
  d.Field("dwell", c.dwell, {.unit = "s", .meaning = "rest of the set-point at each waypoint"});
  d.Field("velocity_time", c.velocity_time, {.unit = "s", .meaning = "filter of the differentiated position"});
  d.Field("velocity_sigma", c.velocity_sigma,
          {.unit = "m/s", .meaning = "stated 1 sigma of that velocity", .min = 1e-3, .max = 100});
  d.Field("setpoint_period", c.setpoint_period, {.unit = "s", .meaning = "between set-points"});
  d.Field("command_lifetime", c.command_lifetime, {.unit = "s", .meaning = "after which a command expires"});
  d.Field("fix_timeout", c.fix_timeout, {.unit = "s", .meaning = "without positions for this long it lands"});
}

std::unique_ptr<NavigationStack> MakePositionRelayStack(const Calibration& calibration, const Mission& mission,
                                                        const PositionRelayConfig& config) {
  return std::make_unique<PositionRelayStack>(calibration, mission, config);
}

}  // namespace alula::stack::pilot
