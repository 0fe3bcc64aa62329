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

/// Flies a recorded trajectory again: poses of some frame S of the vehicle (of its body where nothing else is said) in
/// the file's world F, as TUM writes them (s, p, q x y z w) or EuRoC its ground truth (ns, p, q w x y z). Smooth
/// splines are fitted (file_motion.h); the attitude is the file's, so `attitude` stays as it is.
struct FileMotion {
  std::string path;
  /// s. Shorter follows quicker motion, longer lets less of the recording's noise into acceleration (∝
  /// knot_interval⁻²): at 0.1 s motion up to 2 Hz is followed to 0.1 % and 1 mm of noise at 100 Hz gives 0.1 m/s².
  double knot_interval = 0.1;
  double position_rms = 0.01;                         // m: a fit that misses the file by more is refused
  double attitude_rms = 0.008726646259971648;         // rad (0.5 deg), likewise
  base::Vec3 frame_position = base::Vec3::Zero();     // p_BS, m
  base::Vec3 frame_orientation = base::Vec3::Zero();  // of S in B: yaw, pitch, roll, rad
  base::Vec3 origin = base::Vec3::Zero();             // p_WF, m: where the file's origin lies
  double yaw = 0.0;                                   // rad: of the file's axes in the world
};
void Describe(base::Description& d, FileMotion& c);

using MotionConfig = std::variant<PathMotion, SineMotion, FileMotion>;

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
  MotionConfig motion;
  std::variant<ThrustAttitude, SineAttitude> attitude;
  QuadrotorConfig body;  // what it looks like
  /// Its rotors turn as fast as this motion would want them to: what shakes the inertial unit in flight does so here.
  bool rotors_turn = false;
};
void Describe(base::Description& d, PrescribedConfig& c);

/// A vehicle that is moved along a C⁴ trajectory: exact position, velocity, attitude and angular velocity at every
/// instant. Actuator commands are ignored; the wrench is zero. Throws base::InputError for an empty motion and for a
/// trajectory file that cannot be followed.
std::unique_ptr<VehicleModel> MakePrescribed(const PrescribedConfig& config, std::string name);

}  // namespace alula::vehicles
