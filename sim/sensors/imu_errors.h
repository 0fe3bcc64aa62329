#pragma once

#include <optional>

#include "base/describe.h"
#include "sim/sensors/rotor_vibration.h"
#include "sim/sensors/self_heating.h"
#include "sim/sensors/triad_errors.h"

namespace alula::sim {

/// What a real unit does besides bias and noise; by default nothing. All of it hangs together as
///
///   w = Q[ M_g(ΔT) (w_I + w_vib) + G (f_I + f_vib) + b_g + b_gT ΔT + n_g ],   f = Q[ M_a(ΔT) (f_I + f_vib) + b_a +
///   b_aT ΔT + n_a ]
///
/// with the saturation before the quantiser Q, M of triad_errors.h, ΔT of self_heating.h and the vibration of
/// rotor_vibration.h. G is the gyro's g-sensitivity: what an axis reads of the true specific force, vibration included
/// (IEEE Std 1431; Rehder et al. 2016 in their gyroscope's model, with the force in the gyroscope's axes, here in I).
struct ImuErrors {
  GyroErrors gyro;
  AccelerometerErrors accelerometer;
  base::Vec3 g_sensitivity_x = base::Vec3::Zero();  // of the gyro's x axis to f_x, f_y, f_z, rad/s per m/s²
  base::Vec3 g_sensitivity_y = base::Vec3::Zero();
  base::Vec3 g_sensitivity_z = base::Vec3::Zero();
  SelfHeatingConfig temperature;
  std::optional<RotorVibrationConfig> vibration{};

  base::Mat3 GSensitivity() const;
};
void Describe(base::Description& d, ImuErrors& c);

}  // namespace alula::sim
