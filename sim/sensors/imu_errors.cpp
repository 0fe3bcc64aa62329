#include "sim/sensors/imu_errors.h"

namespace alula::sim {

base::Mat3 ImuErrors::GSensitivity() const {
  base::Mat3 G;
  G << g_sensitivity_x.transpose(), g_sensitivity_y.transpose(), g_sensitivity_z.transpose();
  return G;
}

void Describe(base::Description& d, ImuErrors& c) {
  constexpr const char* kPerForce = "rad/s/(m/s^2)";
  d.Field("gyro", c.gyro, {.meaning = "scale, axes, temperature, quantum of the gyro"});
  d.Field("accelerometer", c.accelerometer, {.meaning = "scale, axes, temperature, quantum of the accelerometer"});
  d.Field("g_sensitivity_x", c.g_sensitivity_x,
          {.unit = kPerForce, .meaning = "what the gyro's x axis reads of specific force along x, y and z"});
  d.Field("g_sensitivity_y", c.g_sensitivity_y, {.unit = kPerForce, .meaning = "likewise of its y axis"});
  d.Field("g_sensitivity_z", c.g_sensitivity_z, {.unit = kPerForce, .meaning = "likewise of its z axis"});
  d.Field("temperature", c.temperature, {.meaning = "how warm the unit is"});
  d.Field("vibration", c.vibration, {.meaning = "of the rotors, at the unit's place"});
}

}  // namespace alula::sim
