#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string_view>

#include "base/describe.h"
#include "base/frames.h"
#include "base/random.h"
#include "base/time.h"
#include "vehicles/ground_effect.h"
#include "vehicles/vortex_ring.h"

namespace alula::vehicles {

/// A propeller on its motor and speed controller. Defaults: a three-bladed 5.1 inch × 4.77 inch propeller on a 2306
/// motor whose controller caps the output, so that a 0.75 kg quadrotor has a thrust-to-weight ratio near 3.7.
struct RotorConfig {
  double diameter = 0.1295;            // m, 5.1 inch
  double thrust_coefficient = 0.179;   // C_T of T = C_T ρ n² D⁴, n in rev/s; static thrust of such propellers
  double torque_coefficient = 0.0176;  // C_Q of Q = C_Q ρ n² D⁵; figure of merit 0.55 at hover
  double zero_thrust_advance = 1.0;    // J = V / (n D) at which thrust vanishes; about pitch / diameter
  double in_plane_drag = 0.04;         // C_H of H = C_H ρ A R |ω| v; 0.3 1/s of mass-normalised drag at hover
  double inertia = 8e-6;               // kg·m², propeller (4.5 g) and bell
  double maximum_speed = 2100.0;       // rad/s at full command and nominal voltage
  double nominal_voltage = 14.8;       // V
  double time_constant = 0.025;        // s, motor lag
  base::Duration esc_delay = base::Milliseconds(2);
  std::optional<GroundEffectConfig> ground_effect{};  // none: the ground is far
  std::optional<VortexRingConfig> vortex_ring{};      // none: thrust grows with descent
};
void Describe(base::Description& d, RotorConfig& c);

/// k_t of T = k_t ω² (N·s²) and k_q of Q = k_q ω² (N·m·s²), from the coefficients: k_t = C_T ρ D⁴ / 4π².
double ThrustConstant(const RotorConfig& c, double air_density);
double TorqueConstant(const RotorConfig& c, double air_density);

/// Where a rotor sits: hub in the body frame (m), axis along body z; spin +1 counter-clockwise seen from above.
struct RotorMount {
  base::Vec3 p_BR = base::Vec3::Zero();
  double spin = 1.0;
};

/// What one rotor does to the body, body axes: force at the hub (N) and torque (N·m), hub lever arm not included.
struct RotorLoad {
  base::Vec3 force_B = base::Vec3::Zero();
  base::Vec3 torque_B = base::Vec3::Zero();
  double shaft_power = 0.0;  // W, that the motor gives
};

/// One rotor, speed ω (rad/s) relative to the body.
///
///   motor     ω' = (ω_max · u(t − delay) · V / V_nominal − ω) / τ         exact over a step of constant command
///   thrust    T = k_t ω² (1 − J / J_0),  J = v_axial / (n D)              thrust falls with axial inflow
///   torque    Q = k_q ω²
///   in plane  H = −C_H ρ A R ω v_in_plane                                 induced drag of blades in side wind
///   reaction  −spin (Q + J_r ω') z − w_B × (spin J_r ω z)                 the body carries the rotor's momentum
///
/// v is the velocity of the hub through the air. Linear thrust over J: McCormick 1995, ch. 6; H-force linear in ω v:
/// Martin and Salaün 2010, eq. 9; Mahony, Kumar and Corke 2012, eq. 9. Thrust gained in descent is capped at 1.4 times
/// the static one. Where they are switched on, ground effect multiplies T by ground_effect.h's ratio, and a vortex ring
/// of strength s (vortex_ring.h) turns it into (1 − s) T + s k_t ω² (1 − loss + n), n a first-order Gauss–Markov
/// process: in the ring there is no gain by inflow.
class Rotor {
 public:
  /// `spacing` of its neighbours, for ground effect; fluctuation of a vortex ring from the seed's stream `name`.
  Rotor(const RotorConfig& config, double air_density, double spin, const RotorSpacing& spacing = {},
        std::uint64_t seed = 1, std::string_view name = "rotor");

  /// Advances by dt under ESC command u in [0, 1] and terminal voltage (V). `v_air_B`: velocity of the hub relative to
  /// the air, `w_B`: angular velocity, body axes. `height`: of the hub above what lies below, m.
  RotorLoad Step(double command, double voltage, const base::Vec3& v_air_B, const base::Vec3& w_B, base::Duration dt,
                 double height = std::numeric_limits<double>::infinity());

  double speed() const { return speed_; }  // rad/s
  /// A failing motor: ω_max becomes √share ω_max, so that share of static thrust and torque is left at every command.
  void Impair(double thrust_share);

 private:
  struct Pending {
    base::Time due;
    double command;
  };

  /// What ground and vortex ring make of a thrust (N).
  double Disturbed(double thrust, const base::Vec3& v_air_B, double height, base::Duration dt);

  RotorConfig config_;
  RotorSpacing spacing_;
  double disc_;  // 2 ρ A of v_h = √(T / 2ρA), kg/m
  base::RandomStream stream_;
  double fluctuation_ = 0.0;  // n / sigma
  double thrust_constant_;
  double torque_constant_;
  double drag_constant_;  // C_H ρ A R
  double spin_;
  double speed_ = 0.0;
  double applied_ = 0.0;
  double speed_share_ = 1.0;  // that the motor still reaches
  base::Time clock_;
  std::deque<Pending> pending_;
};

}  // namespace alula::vehicles
