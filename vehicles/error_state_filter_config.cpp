#include "vehicles/error_state_filter.h"

namespace alula::vehicles {

void Describe(base::Description& d, ErrorStateFilterConfig& c) {
  const auto noise = [&d](std::string_view name, double& value, std::string_view unit, std::string_view meaning) {
    d.Field(name, value, {.unit = unit, .meaning = meaning, .min = 0});
  };
  noise("gyro_noise", c.gyro_noise, "rad/s/sqrt(Hz)", "white noise of the gyro, as believed");
  noise("accelerometer_noise", c.accelerometer_noise, "m/s^2/sqrt(Hz)",
        "white noise of the accelerometer, as believed");
  noise("gyro_bias_walk", c.gyro_bias_walk, "rad/s^2/sqrt(Hz)", "random walk of the gyro's bias");
  noise("accelerometer_bias_walk", c.accelerometer_bias_walk, "m/s^3/sqrt(Hz)",
        "random walk of the accelerometer's bias");
  noise("gyro_turn_on_bias", c.gyro_turn_on_bias, "rad/s", "1 sigma of the bias at power-up");
  noise("accelerometer_turn_on_bias", c.accelerometer_turn_on_bias, "m/s^2", "1 sigma of the bias at power-up");
  noise("barometer_noise", c.barometer_noise, "m", "1 sigma of a barometric height");
  noise("barometer_drift", c.barometer_drift, "m/sqrt(s)", "random walk of the barometer's offset");
  d.Field("vision_interval", c.vision_interval, {.unit = "s", .meaning = "least time between fused estimates"});
  noise("vision_position_floor", c.vision_position_floor, "m", "least 1 sigma believed of a position");
  noise("vision_velocity_floor", c.vision_velocity_floor, "m/s", "least 1 sigma believed of a velocity");
  noise("vision_yaw_floor", c.vision_yaw_floor, "rad", "least 1 sigma believed of a heading");
  d.Field("gate", c.gate, {.meaning = "chi-square gate as a normal quantile, in sigma", .min = 1, .max = 100});
  d.Field("rejection_timeout", c.rejection_timeout,
          {.unit = "s", .meaning = "estimates rejected for so long re-initialise the filter"});
  d.Field("horizon", c.horizon, {.unit = "s", .meaning = "oldest estimate that is still fused"});
  d.Field("standstill", c.standstill, {.unit = "s", .meaning = "averaged for the first attitude and gyro bias"});
  noise("standstill_gyro", c.standstill_gyro, "rad/s", "largest standard deviation of a gyro that stands still");
  noise("standstill_accelerometer", c.standstill_accelerometer, "m/s^2",
        "largest standard deviation of an accelerometer that stands still");
}

}  // namespace alula::vehicles
