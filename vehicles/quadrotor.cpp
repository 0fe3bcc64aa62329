#include "vehicles/quadrotor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"

namespace alula::vehicles {

namespace {

using base::Vec3;

class Quadrotor final : public VehicleModel {
 public:
  Quadrotor(const QuadrotorConfig& config, const std::string& name, std::uint64_t seed)
      : config_(config),
        layout_(LayOutQuadrotor(config)),
        rotors_{MakeRotor(0, name, seed), MakeRotor(1, name, seed), MakeRotor(2, name, seed), MakeRotor(3, name, seed)},
        battery_(config.battery) {
    heights_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < kRotors; ++i) {
      turning_[i] = {
          .spin = layout_.rotors[i].spin, .radius = 0.5 * config.rotor.diameter, .p_BR = layout_.rotors[i].p_BR};
    }
  }

  const VehicleBody& body() const override { return layout_.body; }

  Wrench Step(const BodyState& state, const ActuatorCommand& command, const Vec3& wind_W, base::Duration dt) override {
    if (!command.motors.empty() && command.motors.size() != kRotors) {
      throw base::FaultError("actuator_count", "a quadrotor takes four motor commands");
    }
    const Vec3 v_air_B = state.X_WB.q.conjugate() * (state.v_WB - wind_W);
    Vec3 force_B = BodyDrag(config_.aerodynamics, config_.air_density, v_air_B);
    Vec3 torque_B = Vec3::Zero();
    double power = 0;
    for (std::size_t i = 0; i < kRotors; ++i) {
      const Vec3& p_BR = layout_.rotors[i].p_BR;
      const double u = command.motors.empty() ? 0.0 : command.motors[i];
      const RotorLoad load =
          rotors_[i].Step(u, battery_.voltage(), v_air_B + state.w_B.cross(p_BR), state.w_B, dt, heights_[i]);
      force_B += load.force_B;
      torque_B += p_BR.cross(load.force_B) + load.torque_B;
      power += load.shaft_power;
      turning_[i].speed = rotors_[i].speed();
      turning_[i].thrust = load.force_B.z();
    }
    battery_.Step(power, dt);
    return {state.X_WB.q * force_B, state.X_WB.q * torque_B};
  }

  std::span<const RotorState> Rotors() const override { return turning_; }
  double GroundReach() const override {
    return config_.rotor.ground_effect ? kGroundReach * 0.5 * config_.rotor.diameter : 0.0;
  }
  void Above(std::span<const double> heights) override {
    std::copy_n(heights.begin(), std::min(heights.size(), heights_.size()), heights_.begin());
  }
  int Motors() const override { return kRotors; }
  void Impair(const Impairment& broken) override {
    for (std::size_t i = 0; i < kRotors; ++i) {
      rotors_[i].Impair(i < broken.motor_thrust.size() ? broken.motor_thrust[i] : 1.0);
    }
    battery_.Impair(broken.battery_resistance, broken.battery_voltage);
  }

  stack::BatterySample Battery() const override { return {battery_.voltage(), battery_.current()}; }

  std::vector<TelemetryValue> Telemetry() const override {
    std::vector<TelemetryValue> values;
    for (std::size_t i = 0; i < kRotors; ++i) {
      values.push_back({"rotor" + std::to_string(i) + "_rad_s", rotors_[i].speed()});
    }
    values.push_back({"battery_voltage_v", battery_.voltage()});
    values.push_back({"battery_current_a", battery_.current()});
    values.push_back({"battery_charge", battery_.state_of_charge()});
    return values;
  }

 private:
  Rotor MakeRotor(std::size_t i, const std::string& name, std::uint64_t seed) const {
    const double opposite = config_.frame.wheelbase;
    return Rotor(config_.rotor, config_.air_density, layout_.rotors[i].spin,
                 {0.5 * config_.rotor.diameter, opposite / std::sqrt(2.0), opposite}, seed,
                 name + "/rotor" + std::to_string(i));
  }

  QuadrotorConfig config_;
  QuadrotorLayout layout_;
  std::array<Rotor, kRotors> rotors_;
  std::array<RotorState, kRotors> turning_{};
  std::array<double, kRotors> heights_{};  // above what lies below, m
  vehicles::Battery battery_;
};

void DescribeMass(base::Description& d, std::string_view name, double& value, std::string_view meaning) {
  d.Field(name, value, {.unit = "kg", .meaning = meaning, .min = 1e-6, .max = 100});
}

void DescribeLength(base::Description& d, std::string_view name, double& value, std::string_view meaning) {
  d.Field(name, value, {.unit = "m", .meaning = meaning, .min = 1e-4, .max = 10});
}

}  // namespace

void Describe(base::Description& d, FrameConfig& c) {
  DescribeLength(d, "wheelbase", c.wheelbase, "between opposite motors");
  d.Field("body_size", c.body_size, {.unit = "m", .meaning = "plates and electronics, outer size", .min = 1e-3});
  d.Field("battery_size", c.battery_size, {.unit = "m", .meaning = "battery on top of the body", .min = 1e-3});
  d.Field("camera_size", c.camera_size, {.unit = "m", .meaning = "housing of the stereo camera", .min = 1e-3});
  DescribeLength(d, "camera_forward", c.camera_forward, "centre of the housing before the rotors' centre");
  DescribeLength(d, "camera_below", c.camera_below, "centre of the housing below the arms");
  DescribeLength(d, "rotor_above", c.rotor_above, "propeller discs above the arms");
  DescribeLength(d, "leg_length", c.leg_length, "legs below the arms");
  DescribeLength(d, "leg_radius", c.leg_radius, "radius of a leg");
  DescribeMass(d, "body_mass", c.body_mass, "share of the body; all shares are scaled to the vehicle's mass");
  DescribeMass(d, "battery_mass", c.battery_mass, "share of the battery");
  DescribeMass(d, "arm_mass", c.arm_mass, "share of each arm");
  DescribeMass(d, "motor_mass", c.motor_mass, "share of each motor");
  DescribeMass(d, "propeller_mass", c.propeller_mass, "share of each propeller");
  DescribeMass(d, "leg_mass", c.leg_mass, "share of each leg");
  DescribeMass(d, "camera_mass", c.camera_mass, "share of the camera");
  d.Check("leg_length", [&c] {
    return c.leg_length > 2 * c.leg_radius ? "" : "a leg is longer than its diameter; lengthen it or thin it";
  });
}

void Describe(base::Description& d, QuadrotorConfig& c) {
  d.Field("mass", c.mass, {.unit = "kg", .meaning = "of the whole vehicle", .min = 0.05, .max = 100});
  d.Field("air_density", c.air_density, {.unit = "kg/m^3", .meaning = "density of the air", .min = 0.1, .max = 2});
  d.Field("frame", c.frame, {.meaning = "airframe: solids and their masses"});
  d.Field("rotor", c.rotor, {.meaning = "propeller, motor and speed controller"});
  d.Field("battery", c.battery, {.meaning = "battery"});
  d.Field("aerodynamics", c.aerodynamics, {.meaning = "drag of the airframe"});
}

std::unique_ptr<VehicleModel> MakeQuadrotor(const QuadrotorConfig& config, std::string name, std::uint64_t seed) {
  const double best = kRotors * ThrustConstant(config.rotor, config.air_density) * config.rotor.maximum_speed *
                      config.rotor.maximum_speed;
  if (best < 1.2 * config.mass * base::kGravity) {
    throw base::InputError(name + ": rotor: full thrust is " + std::to_string(best) +
                           " N, which does not lift the mass with a margin of 1.2; raise maximum_speed");
  }
  if (config.rotor.diameter >= config.frame.wheelbase / std::sqrt(2.0)) {
    throw base::InputError(name + ": rotor.diameter: propeller discs overlap; enlarge frame.wheelbase");
  }
  return std::make_unique<Quadrotor>(config, name, seed);
}

}  // namespace alula::vehicles
