#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "render/camera_renderer.h"
#include "sim/magnetic_field.h"
#include "sim/sensors/suite.h"
#include "stack/interface/command.h"
#include "stack/interface/measurement.h"
#include "vehicles/vehicle.h"

namespace alula::scenarios::check {

/// The vehicle's name: streams of noise are those of a run.
inline constexpr const char* kVehicle = "vehicle0";

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// What is put on the test bench: the suite of a scenario, on its vehicle.
struct Rig {
  sim::SensorsConfig sensors;
  vehicles::VehicleBody body;
  base::Duration step = base::Milliseconds(1);
  std::uint64_t seed = 1;
  std::string render = "auto";
  std::vector<vehicles::RotorState> rotors;  // turning on the bench, one after another of the vehicle's
  base::Vec3 v_air_B = base::Vec3::Zero();   // a fan before the bench, m/s
  double rotor_height = std::numeric_limits<double>::infinity();  // above a floor, m
  base::Vec3 B_W = sim::FluxDensity({});                          // magnetic field about the bench, T
  stack::BatterySample battery{.voltage = 12.0, .current = 1.0};
};

/// Without cameras and without the inertial unit: all that takes time.
Rig WithoutCamerasAndImu(Rig rig);

/// The motion that the bench imposes: state of the body at a time.
using Motion = std::function<vehicles::BodyState(base::Time)>;

/// Stands still.
Motion Rest(const base::Transform& X_WB);

/// A gimbal is told something at a time.
struct Turn {
  base::Time at;
  stack::GimbalSetpoint setpoint;
};

using Sink = std::function<void(stack::Measurement&&)>;

/// Carries the suite along the motion as a simulation does and hands over all that it measures, in order of arrival.
/// `renderer`: as SensorSuite wants it. `turns` in order of time.
void Record(const Rig& rig, render::CameraRenderer* renderer, const Motion& motion, base::Duration duration,
            const Sink& sink, const std::vector<Turn>& turns = {});

/// The same, all in one vector.
std::vector<stack::Measurement> Record(const Rig& rig, render::CameraRenderer* renderer, const Motion& motion,
                                       base::Duration duration, const std::vector<Turn>& turns = {});

}  // namespace alula::scenarios::check
