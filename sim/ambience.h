#pragma once

#include <limits>
#include <span>

#include "base/frames.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// What surrounds the sensors of a vehicle besides its motion, at the end of a step. By default: still rotors, still
/// air, far from everything.
struct Ambience {
  std::span<const vehicles::RotorState> rotors{};  // lives as long as the vehicle
};

}  // namespace alula::sim
