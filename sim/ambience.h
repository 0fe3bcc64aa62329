#pragma once

#include <limits>
#include <span>

#include "base/frames.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// What surrounds the sensors of a vehicle besides its motion, at the end of a step. By default: still rotors, still
/// air, far from everything, no magnetic field.
struct Ambience {
  std::span<const vehicles::RotorState> rotors{};  // lives as long as the vehicle
  base::Vec3 v_air_B = base::Vec3::Zero();         // velocity of the body through the air, body axes, m/s
  double rotor_height = std::numeric_limits<double>::infinity();  // of the rotors above what lies below, mean, m
  base::Vec3 B_W = base::Vec3::Zero();                            // magnetic flux density, world axes, T
};

}  // namespace alula::sim
