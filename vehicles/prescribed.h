#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "vehicles/quadrotor.h"
#include "vehicles/vehicle.h"

namespace alula::vehicles {

/// Flies along the polygon through `waypoints`, its corners rounded: a quintic B-spline (C⁴) whose control points are
/// the polygon resampled every speed · knot_interval, with the first and last one repeated, so that it starts and ends
/// at rest with all derivatives zero. It stays inside the polygon's convex hull. The heading follows the direction of
/// flight, as a B-spline of the same kind.
struct PathMotion {
  std::vector<base::Vec3> waypoints;  // m, world
  double speed = 1.5;                 // m/s along straight stretches
  double knot_interval = 0.6;         // s; longer rounds corners more
};
void Describe(base::Description& d, PathMotion& c);

/// p = start + Σ amplitude_i (sin(2π f_i τ + φ_i) − sin φ_i) along each axis; τ is time that starts to run smoothly
/// (C⁴) within `ramp` seconds and comes to a stop likewise at the end.
struct SineTerm {
  base::Vec3 amplitude = base::Vec3::Zero();  // m
  double frequency = 0.1;                     // Hz
  base::Vec3 phase = base::Vec3::Zero();      // rad
};
void Describe(base::Description& d, SineTerm& c);

struct SineMotion {
  base::Vec3 start = base::Vec3::Zero();  // m, world
  std::vector<SineTerm> terms;
  double yaw = 0.0;            // rad, at the start
  double yaw_amplitude = 0.0;  // rad
  double yaw_frequency = 0.1;  // Hz
  double ramp = 4.0;           // s
  double flight_time = 40.0;   // s
};
void Describe(base::Description& d, SineMotion& c);

/// The thrust axis points along a + g, as a quadrotor's must (Mellinger and Kumar 2011, section III).
struct ThrustAttitude {};
void Describe(base::Description& d, ThrustAttitude& c);

/// Roll and pitch are sines of the same running time τ, whatever the acceleration is.
struct SineAttitude {
  double roll_amplitude = 0.1;   // rad
  double roll_frequency = 0.3;   // Hz
  double pitch_amplitude = 0.1;  // rad
  double pitch_frequency = 0.4;  // Hz
};
void Describe(base::Description& d, SineAttitude& c);

struct PrescribedConfig {
  double standstill = 3.0;  // s at rest before the motion begins
  std::variant<PathMotion, SineMotion> motion;
  std::variant<ThrustAttitude, SineAttitude> attitude;
  QuadrotorConfig body;  // what it looks like
};
void Describe(base::Description& d, PrescribedConfig& c);

/// A vehicle that is moved along a C⁴ trajectory: exact position, velocity, attitude and angular velocity at every
/// instant. Actuator commands are ignored; the wrench is zero. Throws base::InputError for an empty motion.
std::unique_ptr<VehicleModel> MakePrescribed(const PrescribedConfig& config, std::string name);

}  // namespace alula::vehicles
