#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "base/describe.h"
#include "vehicles/aerodynamics.h"
#include "vehicles/battery.h"
#include "vehicles/rotor.h"
#include "vehicles/vehicle.h"

namespace alula::vehicles {

/// The airframe of paper P0, section 2.5: Q250 carbon chassis, 250 mm between opposite motors, 2306 motors, 5 inch
/// propellers, 4S 2300 mAh battery, stereo camera at the front. Sizes are outer sizes; masses are shares that are
/// scaled to the vehicle's mass.
struct FrameConfig {
  double wheelbase = 0.25;                       // m, between opposite motors
  base::Vec3 body_size{0.150, 0.046, 0.040};     // m, plates, computer and autopilot
  base::Vec3 battery_size{0.107, 0.034, 0.030};  // m, on top of the body
  base::Vec3 camera_size{0.022, 0.130, 0.024};   // m, housing of the stereo camera
  double camera_forward = 0.088;                 // m, centre of the housing before the rotors' centre
  double camera_below = 0.022;                   // m, below the arms
  double rotor_above = 0.030;                    // m, propeller discs above the arms
  double leg_length = 0.062;                     // m, below the arms
  double leg_radius = 0.006;                     // m
  double body_mass = 0.226;                      // kg
  double battery_mass = 0.230;                   // kg
  double arm_mass = 0.022;                       // kg, each
  double motor_mass = 0.0315;                    // kg, each
  double propeller_mass = 0.0045;                // kg, each
  double leg_mass = 0.004;                       // kg, each
  double camera_mass = 0.046;                    // kg
};
void Describe(base::Description& d, FrameConfig& c);

struct QuadrotorConfig {
  double mass = 0.75;          // kg, in total
  double air_density = 1.225;  // kg/m³, ISA at sea level
  FrameConfig frame;
  RotorConfig rotor;
  BatteryConfig battery;
  AerodynamicsConfig aerodynamics;
};
void Describe(base::Description& d, QuadrotorConfig& c);

/// Number of rotors, in PX4's order: front right, rear left (both counter-clockwise), front left, rear right
/// (clockwise).
inline constexpr int kRotors = 4;

/// The vehicle as solids, with the body origin in their common centre of mass, and where its rotors sit.
struct QuadrotorLayout {
  VehicleBody body;
  std::array<RotorMount, kRotors> rotors;
};
QuadrotorLayout LayOutQuadrotor(const QuadrotorConfig& config);

/// `name` ("vehicle0") prefixes messages. Throws base::InputError where the config makes no flyable vehicle
/// (thrust-to-weight ratio below 1.2, discs that overlap). `seed`: of the run, for what fluctuates ("<name>/rotor0",
/// …).
std::unique_ptr<VehicleModel> MakeQuadrotor(const QuadrotorConfig& config, std::string name, std::uint64_t seed = 1);

}  // namespace alula::vehicles
