#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "base/random.h"
#include "base/time.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// What one rotor at `reference_speed` shakes at the place of the IMU, before the sensor's low-pass.
struct RotorVibrationConfig {
  int blades = 3;
  double reference_speed = 1000.0;  // rad/s, at which the amplitudes below hold
  double imbalance = 0.0;           // m/s², once a revolution, turning in the rotor's plane
  double blade_pass = 0.0;          // m/s², once a blade, along the rotor's axis
  double gyro_imbalance = 0.0;      // rad/s, once a revolution, about axes in the rotor's plane
  double gyro_blade_pass = 0.0;     // rad/s, once a blade, likewise
};
void Describe(base::Description& d, RotorVibrationConfig& c);

/// Vibration at the harmonics of the true rotor speeds Ω_k, as a sensor with the low-pass
/// H(jω) = 1 / (1 − u² + j √2 u), u = ω/ω_c (Butterworth), reads it:
///
///   f_B = Σ_k (Ω_k/Ω_0)² ( a₁ Re[H(jΩ_k) e^{jθ_k} (1, −j s_k, 0)] + a_N Re[H(jNΩ_k) e^{j(Nθ_k + φ_k)}] (0, 0, 1) )
///   w_B = Σ_k (Ω_k/Ω_0)  ( g₁ Re[H(jΩ_k) e^{j(θ_k + ψ_k)} (1, −j s_k, 0)] + g_N Re[H(jNΩ_k) e^{j(Nθ_k + χ_k)} (1, −j
///   s_k, 0)] )
///
/// with θ_k = θ_k(0) + ∫ Ω_k dt, s_k the sense of rotation, N the blades, and phases drawn once. The force of an
/// imbalance m e grows with Ω² (Den Hartog, Mechanical Vibrations, ch. 2, rotating unbalance), as thrust and its ripple
/// do; the angular rate is a torque's integral and grows with Ω. N per revolution: Johnson, Rotorcraft Aeromechanics.
///
/// Evaluated where a sample is taken, never stepped: N Ω lies about or above half the physics rate of 1 kHz (q250 with
/// three blades: 518 Hz at hover, 1003 Hz at full speed) and would fold there by accident. What the sensor's own output
/// rate folds is real: with 200 Hz, 159 Hz reads as 41 Hz. Speeds are taken to change slowly against the filter (motors
/// need 25 ms, the filter 2.5 ms).
class RotorVibration {
 public:
  /// Random numbers of the stream `name`. `corner`: of the low-pass, rad/s.
  RotorVibration(const RotorVibrationConfig& config, double corner, std::uint64_t seed, const std::string& name);

  /// The rotors turn for dt, at these speeds at its end.
  void Turn(std::span<const vehicles::RotorState> rotors, base::Duration dt);

  struct Reading {
    base::Vec3 angular_velocity = base::Vec3::Zero();  // rad/s, body axes
    base::Vec3 specific_force = base::Vec3::Zero();    // m/s², body axes
  };
  /// `ago` before the end of the last Turn.
  Reading At(base::Duration ago) const;

 private:
  struct Phases {
    double speed = 0.0;  // rad/s
    double spin = 1.0;
    double angle = 0.0;            // θ
    double pass, turn, turn_pass;  // φ, ψ, χ
  };
  RotorVibrationConfig config_;
  double corner_;
  base::RandomStream stream_;
  std::vector<Phases> rotors_;
};

}  // namespace alula::sim
