#include "vehicles/rotor.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

namespace {
// Thrust in fast descent over static thrust, at most: beyond, the linear law does not hold.
constexpr double kLargestInflowGain = 1.4;
}  // namespace

void Describe(base::Description& d, RotorConfig& c) {
  d.Field("diameter", c.diameter, {.unit = "m", .meaning = "propeller diameter", .min = 0.01, .max = 2});
  d.Field("thrust_coefficient", c.thrust_coefficient,
          {.meaning = "C_T of T = C_T rho n^2 D^4, n in rev/s", .min = 0.01, .max = 1});
  d.Field("torque_coefficient", c.torque_coefficient,
          {.meaning = "C_Q of Q = C_Q rho n^2 D^5", .min = 0.0, .max = 0.2});
  d.Field("zero_thrust_advance", c.zero_thrust_advance,
          {.meaning = "advance ratio V / (n D) at which thrust vanishes", .min = 0.1, .max = 10});
  d.Field("in_plane_drag", c.in_plane_drag,
          {.meaning = "C_H of H = C_H rho A R |omega| v, drag in the rotor's plane", .min = 0.0, .max = 1});
  d.Field("inertia", c.inertia,
          {.unit = "kg*m^2", .meaning = "moment of inertia of propeller and bell about the shaft", .min = 0.0});
  d.Field("maximum_speed", c.maximum_speed,
          {.unit = "rad/s", .meaning = "speed at full command and nominal voltage", .min = 1, .max = 2e4});
  d.Field("nominal_voltage", c.nominal_voltage,
          {.unit = "V", .meaning = "voltage at which maximum_speed is reached", .min = 1, .max = 100});
  d.Field("time_constant", c.time_constant,
          {.unit = "s", .meaning = "first-order lag of the motor", .min = 1e-4, .max = 1});
  d.Field("esc_delay", c.esc_delay, {.unit = "s", .meaning = "pure delay of the speed controller", .min = 0, .max = 1});
  d.Field("ground_effect", c.ground_effect, {.meaning = "lift that the ground adds; absent: none"});
  d.Field("vortex_ring", c.vortex_ring, {.meaning = "thrust lost when descending into the own wake; absent: none"});
}

double ThrustConstant(const RotorConfig& c, double air_density) {
  return c.thrust_coefficient * air_density * std::pow(c.diameter, 4) / (4 * M_PI * M_PI);
}

double TorqueConstant(const RotorConfig& c, double air_density) {
  return c.torque_coefficient * air_density * std::pow(c.diameter, 5) / (4 * M_PI * M_PI);
}

Rotor::Rotor(const RotorConfig& config, double air_density, double spin, const RotorSpacing& spacing,
             std::uint64_t seed, std::string_view name)
    : config_(config),
      spacing_(spacing),
      disc_(0.5 * M_PI * air_density * config.diameter * config.diameter),
      stream_(seed, name),
      thrust_constant_(ThrustConstant(config, air_density)),
      torque_constant_(TorqueConstant(config, air_density)),
      drag_constant_(config.in_plane_drag * air_density * M_PI * std::pow(0.5 * config.diameter, 3)),
      spin_(spin) {}

void Rotor::Impair(double thrust_share) { speed_share_ = std::sqrt(std::clamp(thrust_share, 0.0, 1.0)); }

double Rotor::Disturbed(double thrust, const base::Vec3& v_air_B, double height, base::Duration dt) {
  const double static_thrust = thrust_constant_ * speed_ * speed_;
  const double induced = std::max(1e-3, std::sqrt(static_thrust / disc_));  // v_h, m/s
  const double horizontal = v_air_B.head<2>().norm() / induced;
  if (config_.vortex_ring) {
    const VortexRingConfig& ring = *config_.vortex_ring;
    const double decay = std::exp(-dt.Seconds() / ring.time_constant);
    fluctuation_ = decay * fluctuation_ + std::sqrt(1.0 - decay * decay) * stream_.Gaussian();
    const double s = VortexRingStrength(ring, -v_air_B.z() / induced, horizontal);
    thrust = (1.0 - s) * thrust + s * static_thrust * (1.0 - ring.thrust_loss + ring.fluctuation * fluctuation_);
  }
  if (config_.ground_effect) thrust *= GroundEffectRatio(*config_.ground_effect, spacing_, height, horizontal);
  return thrust;
}

RotorLoad Rotor::Step(double command, double voltage, const base::Vec3& v_air_B, const base::Vec3& w_B,
                      base::Duration dt, double height) {
  pending_.push_back({clock_ + config_.esc_delay, std::clamp(command, 0.0, 1.0)});
  while (!pending_.empty() && pending_.front().due <= clock_) {
    applied_ = pending_.front().command;
    pending_.pop_front();
  }
  clock_ += dt;

  const double target = speed_share_ * config_.maximum_speed * applied_ * voltage / config_.nominal_voltage;
  const double before = speed_;
  speed_ += -std::expm1(-dt.Seconds() / config_.time_constant) * (target - speed_);
  const double acceleration = (speed_ - before) / dt.Seconds();

  // k_t ω² (1 − J / J_0) with J = 2π V / (ω D), written so that it holds at ω = 0 too.
  const double inflow = 2 * M_PI * v_air_B.z() / (config_.diameter * config_.zero_thrust_advance);
  double thrust = thrust_constant_ * std::min(speed_ * (speed_ - inflow), kLargestInflowGain * speed_ * speed_);
  if (config_.ground_effect || config_.vortex_ring) thrust = Disturbed(thrust, v_air_B, height, dt);
  const double drag_torque = torque_constant_ * speed_ * speed_;
  const double shaft_torque = drag_torque + config_.inertia * acceleration;

  RotorLoad load;
  load.force_B = {-drag_constant_ * speed_ * v_air_B.x(), -drag_constant_ * speed_ * v_air_B.y(), thrust};
  const base::Vec3 momentum_B(0, 0, spin_ * config_.inertia * speed_);
  load.torque_B = base::Vec3(0, 0, -spin_ * shaft_torque) - w_B.cross(momentum_B);
  load.shaft_power = shaft_torque * speed_;
  return load;
}

}  // namespace alula::vehicles
