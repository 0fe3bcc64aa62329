#include "sim/sensors/self_heating.h"

#include <cmath>

namespace alula::sim {

void Describe(base::Description& d, SelfHeatingConfig& c) {
  d.Field("ambient", c.ambient,
          {.unit = "K", .meaning = "surroundings above the temperature of calibration", .min = -100, .max = 100});
  d.Field("rise", c.rise, {.unit = "K", .meaning = "of the warm sensor above its surroundings", .min = 0, .max = 100});
  d.Field("time_constant", c.time_constant, {.unit = "s", .meaning = "of warming up", .min = 0.1, .max = 1e5});
  d.Field("powered_for", c.powered_for, {.unit = "s", .meaning = "switched on before the run begins", .min = 0});
}

double AboveCalibration(const SelfHeatingConfig& config, double t) {
  return config.ambient - config.rise * std::expm1(-(t + config.powered_for) / config.time_constant);
}

}  // namespace alula::sim
