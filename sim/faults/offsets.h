#pragma once

#include <string>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "sim/faults/sensor_choice.h"

namespace alula::sim::faults {

/// What is added to a sensor's readings, by quantity; 0: nothing. Each kind of sample has its own of these.
struct Offsets {
  base::Vec3 angular_velocity = base::Vec3::Zero();  // of an IMU, its axes, rad/s
  base::Vec3 specific_force = base::Vec3::Zero();    // of an IMU, its axes, m/s²
  double pressure = 0.0;                             // of a barometer, Pa
  base::Vec3 magnetic_field = base::Vec3::Zero();    // of a magnetometer, its axes, T
  base::Vec3 position = base::Vec3::Zero();          // of a position reference, world axes, m
  base::Vec3 attitude = base::Vec3::Zero();          // of a position reference, rotation vector in body axes, rad
  double voltage = 0.0;                              // of the battery's gauge, V
  double current = 0.0;                              // of the battery's gauge, A
  double brightness = 0.0;                           // of every pixel, grey levels; cut off at 0 and 255
  double depth = 0.0;                                // of every pixel that measures, m
  base::Vec3 angles = base::Vec3::Zero();            // of a gimbal's encoders: roll, pitch, yaw, rad
};
/// Its keys.
void DescribeOffsets(base::Description& d, Offsets& c);

/// Quantities that are not 0, by name.
std::vector<std::string> Given(const Offsets& offsets);

/// The same with their values, for events.
std::string Listed(const Offsets& offsets);

/// Throws base::InputError where a quantity is given that none of the sensors has, and where a sensor has none of those
/// that are given.
void CheckOffsets(const Offsets& offsets, const std::vector<Sensor>& sensors, const base::Origin& origin);

/// sample + k · offsets. An attitude turns by Exp(k δ) on the right; pixels are rounded and cut off at their range.
void Add(const Offsets& offsets, double k, decltype(stack::Measurement::data)& sample);

}  // namespace alula::sim::faults
