// A navigation stack of your own, whole: it takes off on positions from motion capture, visits the mission's waypoints,
// rests at each, lands where the last one was and says so. Begin with it and put your own software into it.
//
// It needs plugin.h and nothing else of Alula. README.md beside it says how to build and fly it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "plugin.h"

namespace {

constexpr int64_t kSecond = 1000000000;            // all times are integer nanoseconds since the start of the run
constexpr int64_t kSetpointPeriod = kSecond / 50;  // a set-point every 20 ms …
constexpr int64_t kRepeatPeriod = kSecond / 2;  // … and a word like "arm" or "land" twice a second until it is obeyed
constexpr int64_t kLifetime = kSecond / 2;      // a command without a successor for this long means a silent stack
constexpr double kSpeed = 0.7;                  // m/s, mean speed between two waypoints
constexpr double kShortestLeg = 2.0;            // s
constexpr double kRest = 12.0;                  // s at each waypoint
constexpr double kVelocityTime = 0.12;          // s, filter of the differentiated position
constexpr double kVelocitySigma = 0.5;          // m/s, what we claim for that velocity: it lags

AlulaVec3 operator+(AlulaVec3 a, AlulaVec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
AlulaVec3 operator-(AlulaVec3 a, AlulaVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
AlulaVec3 operator*(double s, AlulaVec3 a) { return {s * a.x, s * a.y, s * a.z}; }

double Yaw(const AlulaQuat& q) { return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)); }

class MyStack {
 public:
  // Calibration and mission say what is known before the flight; take what you need, and refuse what you cannot fly.
  explicit MyStack(const AlulaSetup& setup)
      : position_sensor_(setup.calibration->position_reference->sensor),
        waypoints_(setup.mission->waypoints, setup.mission->waypoints + setup.mission->waypoint_count) {}

  // Called every millisecond of simulated time with what the sensors have delivered since the last call.
  void Step(int64_t now, const AlulaMeasurement* measurements, uint64_t count, AlulaOutput& output) {
    commands_.clear();
    events_.clear();
    for (uint64_t i = 0; i < count; ++i) {
      const AlulaMeasurement& m = measurements[i];
      if (m.kind == ALULA_VEHICLE_STATUS) status_ = m.data.status;
      if (m.kind == ALULA_POSITION_FIX && m.sensor == position_sensor_) {  // and not the fixes of satellites
        Estimate(m);
        output.estimate = &estimate_;  // the autopilot flies on it: send one as often as you can
      }
    }
    Decide(now);
    output.commands = commands_.data();  // these may stay where they are until the next call
    output.command_count = commands_.size();
    output.events = events_.data();
    output.event_count = events_.size();
    output.state = state_;
  }

 private:
  // Here, motion capture stands in for your odometry: position and attitude as they come, velocity by difference.
  void Estimate(const AlulaMeasurement& m) {
    const AlulaPositionFix& fix = m.data.position_fix;
    if (have_estimate_) {
      const double dt = 1e-9 * static_cast<double>(m.captured_ns - estimate_.stamp_ns);
      const double gain = 1 - std::exp(-dt / kVelocityTime);
      const AlulaVec3 v = (1 / dt) * (fix.X_WB.p - estimate_.X_OB.p);
      estimate_.v_OB = estimate_.v_OB + gain * (v - estimate_.v_OB);
    }
    have_estimate_ = true;
    estimate_.stamp_ns = m.captured_ns;
    estimate_.X_OB = fix.X_WB;          // our odometry frame O is the world
    estimate_.X_MO = alula_identity();  // and so is the mission's frame M
    for (int i = 0; i < 3; ++i) {
      estimate_.pose_covariance[7 * i] = fix.position_sigma * fix.position_sigma;        // diagonal of [6x6]
      estimate_.pose_covariance[7 * (i + 3)] = fix.attitude_sigma * fix.attitude_sigma;  // its rotation part
      estimate_.velocity_covariance[4 * i] = kVelocitySigma * kVelocitySigma;            // diagonal of [3x3]
    }
  }

  // The mission as a small state machine.
  void Decide(int64_t now) {
    switch (state_) {
      case ALULA_INITIALISING:  // until positions arrive and the autopilot has settled on them
        if (have_estimate_ && status_.ready_to_arm) Enter(ALULA_READY, now, "arming", "the autopilot is ready");
        break;
      case ALULA_READY:
        if (!status_.armed) return Repeat(ALULA_ARM, now);
        Enter(ALULA_FLYING, now, "take_off", "climbing");
        yaw_ = Yaw(estimate_.X_OB.q);
        goal_ = estimate_.X_OB.p;
        StartLeg(now);
        break;
      case ALULA_FLYING:
        if (landing_ && !status_.armed) return Enter(ALULA_DONE, now, "landed", "on the ground and disarmed");
        if (landing_) return Repeat(ALULA_LAND, now);
        if (now >= leg_start_ + leg_duration_ + static_cast<int64_t>(kRest * kSecond)) StartLeg(now);
        if (now >= next_command_) Follow(now);
        break;
      default:  // done
        break;
    }
  }

  // A straight leg to the next waypoint, or the landing after the last one.
  void StartLeg(int64_t now) {
    landing_ = next_waypoint_ == waypoints_.size();
    if (landing_) return Say(now, "landing", "all waypoints visited");
    leg_from_ = goal_;
    goal_ = waypoints_[next_waypoint_++];
    const AlulaVec3 d = goal_ - leg_from_;
    leg_start_ = now;
    leg_duration_ = static_cast<int64_t>(kSecond * std::max(kShortestLeg, std::hypot(d.x, d.y, d.z) / kSpeed));
  }

  // The point of the leg for now, with its velocity and acceleration: s(t) = 10 t³ − 15 t⁴ + 6 t⁵, from rest to rest.
  void Follow(int64_t now) {
    next_command_ = now + kSetpointPeriod;
    const double T = 1e-9 * static_cast<double>(leg_duration_);
    const double t = std::min(1.0, 1e-9 * static_cast<double>(now - leg_start_) / T);
    const AlulaVec3 d = goal_ - leg_from_;
    AlulaCommand& command = Send(ALULA_POSITION_SETPOINT, now);
    command.data.position.p_OB = leg_from_ + (t * t * t * (10 - t * (15 - 6 * t))) * d;
    command.data.position.v_OB = (30 * t * t * (1 - t) * (1 - t) / T) * d;
    command.data.position.a_OB = (60 * t * (1 - t) * (1 - 2 * t) / (T * T)) * d;
    command.data.position.yaw = yaw_;
  }

  // The link may lose a word: say it until the status shows that it was heard.
  void Repeat(uint32_t kind, int64_t now) {
    if (now < next_command_) return;
    next_command_ = now + kRepeatPeriod;
    Send(kind, now);
  }

  AlulaCommand& Send(uint32_t kind, int64_t now) {
    AlulaCommand command{};
    command.kind = kind;
    command.issued_ns = now;
    command.expires_ns = now + kLifetime;
    commands_.push_back(command);
    return commands_.back();
  }

  void Enter(uint32_t state, int64_t now, const char* kind, const char* text) {
    state_ = state;
    Say(now, kind, text);
  }

  // A line for events.jsonl of the run folder. The texts must outlive the call, as these literals do.
  void Say(int64_t now, const char* kind, const char* text) {
    events_.push_back({now, alula_text(kind), alula_text(text)});
  }

  uint16_t position_sensor_;
  std::vector<AlulaVec3> waypoints_;
  uint32_t state_ = ALULA_INITIALISING;
  AlulaVehicleStatus status_{};
  AlulaEstimate estimate_{};
  bool have_estimate_ = false;
  bool landing_ = false;
  double yaw_ = 0;
  AlulaVec3 leg_from_{}, goal_{};
  int64_t leg_start_ = 0, leg_duration_ = 0, next_command_ = 0;
  std::size_t next_waypoint_ = 0;
  std::vector<AlulaCommand> commands_;
  std::vector<AlulaEvent> events_;
};

// The functions that Alula calls. Nothing may be thrown out of them: it is caught here and becomes a text.

int32_t Create(const AlulaSetup* setup, void** self, AlulaError* error) try {
  if (setup->calibration->position_reference == nullptr || setup->mission->waypoint_count == 0) {
    std::snprintf(error->text, sizeof error->text, "my_stack needs a position reference and waypoints");
    return ALULA_BAD_INPUT;
  }
  *self = new MyStack(*setup);
  return ALULA_OK;
} catch (const std::exception& e) {
  std::snprintf(error->text, sizeof error->text, "%s", e.what());
  return ALULA_FAILED;
}

int32_t Step(void* self, int64_t now_ns, const AlulaMeasurement* measurements, uint64_t count, AlulaOutput* output,
             AlulaError* error) try {
  static_cast<MyStack*>(self)->Step(now_ns, measurements, count, *output);
  return ALULA_OK;
} catch (const std::exception& e) {
  std::snprintf(error->text, sizeof error->text, "%s", e.what());
  return ALULA_FAILED;
}

void Destroy(void* self) { delete static_cast<MyStack*>(self); }

}  // namespace

// The one symbol of the library.
extern "C" ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void) {
  static const AlulaStackPlugin plugin = {
      ALULA_STACK_ABI_VERSION, 0, ALULA_LAYOUT, "my_stack", Create, Step, nullptr, nullptr, Destroy};
  return &plugin;
}
