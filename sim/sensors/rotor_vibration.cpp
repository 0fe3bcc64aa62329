#include "sim/sensors/rotor_vibration.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace alula::sim {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// H(jω) e^{jα}.
std::complex<double> Filtered(double speed, double corner, double angle) {
  const double u = speed / corner;
  return std::polar(1.0, angle) / std::complex<double>(1.0 - u * u, std::numbers::sqrt2 * u);
}

/// Re[z (1, −j s, 0)]: turns in the rotor's plane.
base::Vec3 Circling(std::complex<double> z, double spin) { return {z.real(), spin * z.imag(), 0.0}; }

}  // namespace

void Describe(base::Description& d, RotorVibrationConfig& c) {
  d.Field("blades", c.blades, {.meaning = "of one rotor", .min = 1, .max = 12});
  d.Field("reference_speed", c.reference_speed,
          {.unit = "rad/s", .meaning = "rotor speed at which the amplitudes hold", .min = 1});
  d.Field("imbalance", c.imbalance,
          {.unit = "m/s^2", .meaning = "acceleration once a revolution, of one rotor, in its plane", .min = 0});
  d.Field("blade_pass", c.blade_pass,
          {.unit = "m/s^2", .meaning = "acceleration once a blade, of one rotor, along its axis", .min = 0});
  d.Field("gyro_imbalance", c.gyro_imbalance,
          {.unit = "rad/s", .meaning = "angular velocity once a revolution, of one rotor", .min = 0});
  d.Field("gyro_blade_pass", c.gyro_blade_pass,
          {.unit = "rad/s", .meaning = "angular velocity once a blade, of one rotor", .min = 0});
}

RotorVibration::RotorVibration(const RotorVibrationConfig& config, double corner, std::uint64_t seed,
                               const std::string& name)
    : config_(config), corner_(corner), stream_(seed, name) {}

void RotorVibration::Turn(std::span<const vehicles::RotorState> rotors, base::Duration dt) {
  while (rotors_.size() < rotors.size()) {
    const double angle = kTurn * stream_.Uniform(), pass = kTurn * stream_.Uniform(), turn = kTurn * stream_.Uniform();
    rotors_.push_back(
        {rotors[rotors_.size()].speed, rotors[rotors_.size()].spin, angle, pass, turn, kTurn * stream_.Uniform()});
  }
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    Phases& rotor = rotors_[i];
    rotor.angle = std::fmod(rotor.angle + 0.5 * (rotor.speed + rotors[i].speed) * dt.Seconds(), kTurn);
    rotor.speed = rotors[i].speed;
  }
}

RotorVibration::Reading RotorVibration::At(base::Duration ago) const {
  Reading sum;
  for (const Phases& rotor : rotors_) {
    const double angle = rotor.angle - rotor.speed * ago.Seconds();
    const double ratio = rotor.speed / config_.reference_speed;
    const double pass_speed = config_.blades * rotor.speed, pass_angle = config_.blades * angle;
    sum.specific_force +=
        ratio * ratio * config_.imbalance * Circling(Filtered(rotor.speed, corner_, angle), rotor.spin);
    sum.specific_force.z() +=
        ratio * ratio * config_.blade_pass * Filtered(pass_speed, corner_, pass_angle + rotor.pass).real();
    sum.angular_velocity +=
        ratio * config_.gyro_imbalance * Circling(Filtered(rotor.speed, corner_, angle + rotor.turn), rotor.spin) +
        ratio * config_.gyro_blade_pass *
            Circling(Filtered(pass_speed, corner_, pass_angle + rotor.turn_pass), rotor.spin);
  }
  return sum;
}

}  // namespace alula::sim
