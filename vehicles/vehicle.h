#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "geometry/material.h"
#include "geometry/shape.h"
#include "stack/interface/command.h"
#include "stack/interface/measurement.h"
#include "stack/interface/navigation_stack.h"

namespace alula::vehicles {

/// State of the body frame B (its origin is the centre of mass) in the world.
struct BodyState {
  base::Transform X_WB;
  base::Vec3 v_WB = base::Vec3::Zero();
  base::Vec3 w_B = base::Vec3::Zero();  // angular velocity, body axes, rad/s
};

/// One solid of a vehicle.
struct Part {
  std::string name;
  geometry::Shape shape;
  base::Transform X_BP;
  geometry::Material material;
  bool collides = true;    // part of Bullet's compound
  bool hull = true;        // counts for contacts and clearance (body and propeller discs)
  bool may_touch = false;  // legs: may touch the pad
};

/// A vehicle as data: what Bullet and the renderer are built from.
struct VehicleBody {
  double mass = 0.0;                            // kg
  base::Mat3 inertia = base::Mat3::Identity();  // about the body origin, body axes, kg·m²
  std::vector<Part> parts;
  double standing_height = 0.0;  // of the body origin above the ground, legs down, m
  double hull_radius = 0.0;      // m
  base::Vec3 hull_half_extents = base::Vec3::Zero();
  /// A vehicle that follows a prescribed motion is moved, not pushed.
  bool prescribed = false;
};

/// Force at the centre of mass and torque about it, world axes.
struct Wrench {
  base::Vec3 force_W = base::Vec3::Zero();
  base::Vec3 torque_W = base::Vec3::Zero();
};

/// What an autopilot gives its actuators: one value a motor in [0, 1] (ESC command), zero when disarmed.
struct ActuatorCommand {
  std::vector<double> motors;
};

/// What is broken of a vehicle at the moment; by default nothing.
struct Impairment {
  std::vector<double> motor_thrust;  // by motor, share of its thrust that is left; motors beyond: all of it
  double battery_resistance = 1.0;   // factor on the battery's internal resistance
  double battery_voltage = 1.0;      // share of its open-circuit voltage
};

/// What one rotor does at the moment, for what feels it besides the body.
struct RotorState {
  double speed = 0.0;                    // rad/s relative to the body
  double spin = 1.0;                     // +1 counter-clockwise seen from above
  double thrust = 0.0;                   // N
  double radius = 0.0;                   // m
  base::Vec3 p_BR = base::Vec3::Zero();  // hub, m
};

/// Inner quantities worth recording, each with its name and unit ("rotor0_rad_s").
struct TelemetryValue {
  std::string name;
  double value = 0.0;
};

/// The physics of a vehicle besides rigid-body motion and contacts, which Bullet does.
class VehicleModel {
 public:
  virtual ~VehicleModel() = default;
  virtual const VehicleBody& body() const = 0;
  /// Advances actuators and battery by dt and returns what acts on the body during it (gravity excluded).
  /// `wind_W`: air velocity at the vehicle, m/s.
  virtual Wrench Step(const BodyState& state, const ActuatorCommand& command, const base::Vec3& wind_W,
                      base::Duration dt) = 0;
  /// Rotors after the last step; none where nothing turns.
  virtual std::span<const RotorState> Rotors() const { return {}; }
  /// Height of a rotor (m) above which what lies below does not matter; 0: it never does.
  virtual double GroundReach() const { return 0.0; }
  /// Height of each rotor above what lies below it, m, for the next step; infinite where nothing does.
  virtual void Above(std::span<const double>) {}
  /// Motors that may fail.
  virtual int Motors() const { return 0; }
  /// From the next step on this is broken, and nothing else.
  virtual void Impair(const Impairment&) {}
  /// The prescribed state at time t, for a vehicle whose body says `prescribed`.
  virtual BodyState Prescribed(base::Time) const { return {}; }
  /// When the prescribed motion ends.
  virtual std::optional<base::Time> PrescribedEnd() const { return std::nullopt; }
  virtual stack::BatterySample Battery() const = 0;
  virtual std::vector<TelemetryValue> Telemetry() const = 0;
};

/// The autopilot's own sensor readings at one of its ticks (1 kHz).
struct AutopilotSensors {
  stack::ImuSample imu;
  bool imu_fresh = true;  // taken for this tick; otherwise the last one once more
  std::optional<stack::BaroSample> barometer;
  double battery_voltage = 0.0;
};

struct AutopilotOutput {
  ActuatorCommand actuators;
  stack::VehicleStatus status;
};

/// Low-level flight (or wheel) controller. It knows its own sensors and what the stack sends (already delayed by the
/// link); never the truth.
class Autopilot {
 public:
  virtual ~Autopilot() = default;
  virtual void Receive(base::Time now, const stack::Command& command) = 0;
  virtual void Receive(base::Time now, const stack::Estimate& estimate) = 0;
  virtual AutopilotOutput Step(base::Time now, const AutopilotSensors& sensors) = 0;
  /// The autopilot's own state estimate in the odometry frame, where it has one; for recording only.
  virtual std::optional<BodyState> OwnEstimate() const { return std::nullopt; }
};

}  // namespace alula::vehicles
