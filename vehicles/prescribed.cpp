#include "vehicles/prescribed.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "vehicles/file_motion.h"
#include "vehicles/flatness.h"
#include "vehicles/prescribed_motion.h"

namespace alula::vehicles {

namespace {

using base::Vec3;

/// Roll and pitch as sines of the running time; body rates from the rates of yaw, pitch and roll (z-y'-x'').
FlatAttitude AttitudeFromSines(const SineAttitude& c, const MotionSample& s) {
  const double wr = 2 * M_PI * c.roll_frequency, wp = 2 * M_PI * c.pitch_frequency;
  const double roll = c.roll_amplitude * std::sin(wr * s.clock.tau);
  const double roll_rate = c.roll_amplitude * wr * std::cos(wr * s.clock.tau) * s.clock.rate;
  const double pitch = c.pitch_amplitude * std::sin(wp * s.clock.tau);
  const double pitch_rate = c.pitch_amplitude * wp * std::cos(wp * s.clock.tau) * s.clock.rate;
  return {base::FromYawPitchRoll(s.yaw, pitch, roll),
          {roll_rate - s.yaw_rate * std::sin(pitch),
           pitch_rate * std::cos(roll) + s.yaw_rate * std::sin(roll) * std::cos(pitch),
           -pitch_rate * std::sin(roll) + s.yaw_rate * std::cos(roll) * std::cos(pitch)}};
}

class PrescribedVehicle final : public VehicleModel {
 public:
  PrescribedVehicle(const PrescribedConfig& config, const std::string& name)
      : config_(config), body_(LayOutQuadrotor(config.body).body) {
    body_.prescribed = true;
    const QuadrotorLayout layout = LayOutQuadrotor(config.body);
    for (std::size_t i = 0; i < rotors_.size(); ++i) {
      rotors_[i].spin = layout.rotors[i].spin;
      rotors_[i].radius = 0.5 * config.body.rotor.diameter;
      rotors_[i].p_BR = layout.rotors[i].p_BR;
    }
    if (const auto* file = std::get_if<FileMotion>(&config.motion)) {
      if (!std::holds_alternative<ThrustAttitude>(config.attitude)) {
        throw base::InputError(name + ": attitude: a motion of type file brings its own; leave the key out");
      }
      recorded_.emplace(*file, config.standstill);
    } else {
      formula_.emplace(config.motion, name);
    }
  }

  const VehicleBody& body() const override { return body_; }
  Wrench Step(const BodyState& state, const ActuatorCommand&, const Vec3&, base::Duration dt) override {
    if (config_.rotors_turn) {
      const Vec3 a_W = v_before_ ? Vec3((state.v_WB - *v_before_) / dt.Seconds()) : Vec3::Zero();
      v_before_ = state.v_WB;
      const double thrust = config_.body.mass * (a_W + Vec3(0, 0, base::kGravity)).norm() / kRotors;
      for (RotorState& rotor : rotors_) {
        rotor.thrust = thrust;
        rotor.speed = std::sqrt(thrust / ThrustConstant(config_.body.rotor, config_.body.air_density));
      }
    }
    return {};
  }
  std::span<const RotorState> Rotors() const override {
    return config_.rotors_turn ? std::span<const RotorState>(rotors_) : std::span<const RotorState>();
  }

  BodyState Prescribed(base::Time t) const override {
    const double since = t.Seconds() - config_.standstill;
    if (recorded_) {
      const FlatAttitude attitude = recorded_->Attitude(since);
      return {
          .X_WB = {attitude.q_WB, recorded_->Position(since)}, .v_WB = recorded_->Velocity(since), .w_B = attitude.w_B};
    }
    const MotionSample s = formula_->At(since);
    const auto* sines = std::get_if<SineAttitude>(&config_.attitude);
    const FlatAttitude attitude =
        sines ? AttitudeFromSines(*sines, s) : AttitudeFromThrust(s.a, s.jerk, s.yaw, s.yaw_rate);
    return {.X_WB = {attitude.q_WB, s.p}, .v_WB = s.v, .w_B = attitude.w_B};
  }

  std::optional<base::Time> PrescribedEnd() const override {
    const double duration = recorded_ ? recorded_->duration() : formula_->duration();
    return base::Time{} + base::Seconds(config_.standstill + duration);
  }

  stack::BatterySample Battery() const override {
    return {config_.body.battery.cells * CellVoltage(config_.body.battery.initial_charge), 0.0};
  }
  std::vector<TelemetryValue> Telemetry() const override { return {}; }

 private:
  PrescribedConfig config_;
  VehicleBody body_;
  std::array<RotorState, kRotors> rotors_{};
  std::optional<Vec3> v_before_;
  std::optional<PrescribedMotion> formula_;  // one of the two
  std::optional<FittedMotion> recorded_;
};

void Angle(base::Description& d, std::string_view name, double& value, std::string_view meaning) {
  d.Field(name, value, {.unit = "rad", .meaning = meaning});
}
void Frequency(base::Description& d, std::string_view name, double& value, std::string_view meaning) {
  d.Field(name, value, {.unit = "Hz", .meaning = meaning, .min = 0, .max = 100});
}

}  // namespace

void Describe(base::Description& d, PathMotion& c) {
  d.Field("waypoints", c.waypoints, {.unit = "m", .meaning = "corners of the polygon that is followed, world"});
  d.Field("speed", c.speed, {.unit = "m/s", .meaning = "along straight stretches", .min = 0.01, .max = 50});
  d.Field("knot_interval", c.knot_interval,
          {.unit = "s", .meaning = "time between control points; longer rounds corners more", .min = 0.05, .max = 10});
}

void Describe(base::Description& d, SineTerm& c) {
  d.Field("amplitude", c.amplitude, {.unit = "m", .meaning = "along world x, y and z"});
  Frequency(d, "frequency", c.frequency, "of this term");
  d.Field("phase", c.phase, {.unit = "rad", .meaning = "at the start, along x, y and z"});
}

void Describe(base::Description& d, SineMotion& c) {
  d.Field("start", c.start, {.unit = "m", .meaning = "where it begins, world"});
  d.Field("terms", c.terms, {.meaning = "sines that are summed"});
  Angle(d, "yaw", c.yaw, "heading at the start");
  Angle(d, "yaw_amplitude", c.yaw_amplitude, "of the heading's sine");
  Frequency(d, "yaw_frequency", c.yaw_frequency, "of the heading's sine");
  d.Field("ramp", c.ramp, {.unit = "s", .meaning = "from standstill to full rate, and back", .min = 0.1, .max = 100});
  d.Field("flight_time", c.flight_time, {.unit = "s", .meaning = "with both ramps", .min = 0.2, .max = 1e5});
}

void Describe(base::Description& d, FileMotion& c) {
  d.Field("path", c.path,
          {.meaning = "trajectory: TUM, or EuRoC's ground-truth CSV; what it is shows inside",
           .required = true,
           .is_path = true});
  d.Field("knot_interval", c.knot_interval,
          {.unit = "s", .meaning = "of the fitted splines; shorter follows quicker motion", .min = 0.01, .max = 10});
  d.Field("position_rms", c.position_rms, {.unit = "m", .meaning = "largest residual of the fit", .min = 0});
  d.Field("attitude_rms", c.attitude_rms, {.unit = "rad", .meaning = "largest residual of the fit", .min = 0});
  d.Field("frame_position", c.frame_position,
          {.unit = "m", .meaning = "in the body, of the frame whose poses the file gives (an IMU, say)"});
  d.Field("frame_orientation", c.frame_orientation,
          {.unit = "rad", .meaning = "in the body, of the frame whose poses the file gives: yaw, pitch, roll"});
  d.Field("origin", c.origin, {.unit = "m", .meaning = "where the file's origin lies in the world"});
  Angle(d, "yaw", c.yaw, "of the file's axes in the world");
}

void Describe(base::Description&, ThrustAttitude&) {}

void Describe(base::Description& d, SineAttitude& c) {
  Angle(d, "roll_amplitude", c.roll_amplitude, "of the roll's sine");
  Frequency(d, "roll_frequency", c.roll_frequency, "of the roll's sine");
  Angle(d, "pitch_amplitude", c.pitch_amplitude, "of the pitch's sine");
  Frequency(d, "pitch_frequency", c.pitch_frequency, "of the pitch's sine");
}

void Describe(base::Description& d, PrescribedConfig& c) {
  d.Field("standstill", c.standstill,
          {.unit = "s", .meaning = "at rest before the motion begins", .min = 0, .max = 1e4});
  d.OneOf("motion", c.motion, {.meaning = "where it goes", .choices = {"path", "sines", "file"}});
  d.OneOf("attitude", c.attitude, {.meaning = "how it tilts (a file has its own)", .choices = {"thrust", "sines"}});
  d.Field("body", c.body, {.meaning = "the quadrotor that it looks like"});
  d.Field("rotors_turn", c.rotors_turn,
          {.meaning = "rotors turn as the motion would want it, and shake the inertial unit (its errors.vibration)"});
}

std::unique_ptr<VehicleModel> MakePrescribed(const PrescribedConfig& config, std::string name) {
  return std::make_unique<PrescribedVehicle>(config, name);
}

}  // namespace alula::vehicles
