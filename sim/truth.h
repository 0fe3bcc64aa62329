#pragma once

#include "base/time.h"
#include "sim/ambience.h"
#include "vehicles/vehicle.h"

namespace alula::sim {

/// The true motion over the last physics step, from which sensors read any instant inside it.
struct TruthWindow {
  base::Time begin, end;
  vehicles::BodyState at_begin, at_end;
  Ambience ambience{};  // at the end

  /// Position by cubic Hermite, attitude along the geodesic, rates linearly; `t` is clamped to the window.
  vehicles::BodyState At(base::Time t) const;
};

/// What an IMU adds to its readings, in its own axes, besides white noise.
struct ImuBias {
  base::Vec3 gyro = base::Vec3::Zero();           // rad/s
  base::Vec3 accelerometer = base::Vec3::Zero();  // m/s²
};

}  // namespace alula::sim
