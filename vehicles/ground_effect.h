#pragma once

#include "base/describe.h"

namespace alula::vehicles {

/// Lift that the ground adds to the rotors of a multirotor.
struct GroundEffectConfig {
  double body_lift = 2.0;  // K_b: of the fountain below the body; measured by the source
};
void Describe(base::Description& d, GroundEffectConfig& c);

/// Where the rotors of a square quadrotor sit against each other, m.
struct RotorSpacing {
  double radius = 0.0;    // R
  double adjacent = 0.0;  // d, between neighbouring axes
  double opposite = 0.0;  // b, between opposite axes
};

/// Thrust in ground effect over thrust out of it at the same rotor speed, z above the ground:
///
///   T_IGE / T_OGE = 1 / (1 − [ (R/4z)² + R² z / √(d² + 4z²)³ + ½ R² z / √(2d² + 4z²)³ + 2 K_b R² z / √(b² + 4z²)³ ] /
///   (1 + (V/v_i)²))
///
/// Bracket: Sanchez-Cuevas, Heredia and Ollero 2017, "Characterization of the aerodynamic ground effect and its
/// influence in multirotor control", eq. 4 (image sources of all four rotors, and the fountain on the body); its first
/// term alone, and how it fades with the air's horizontal speed V: Cheeseman and Bennett 1955, applied here to the
/// whole bracket and with the induced velocity v_i of hover at the same rotor speed. Measured down to z = R/2, where z
/// is held: discs do not come nearer. The bracket is held at 1/2, which no layout of discs side by side reaches.
/// `speed_ratio` = V / v_i.
double GroundEffectRatio(const GroundEffectConfig& config, const RotorSpacing& spacing, double z, double speed_ratio);

/// Height in radii beyond which the ratio lies below 1.005 for usual spacings.
inline constexpr double kGroundReach = 16.0;

}  // namespace alula::vehicles
