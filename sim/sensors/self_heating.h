#pragma once

#include "base/describe.h"

namespace alula::sim {

/// How warm a sensor is. Defaults: always at the temperature at which it was calibrated.
struct SelfHeatingConfig {
  double ambient = 0.0;          // K, the surroundings above the temperature of calibration
  double rise = 0.0;             // K, of the sensor above its surroundings once it is warm
  double time_constant = 120.0;  // s
  double powered_for = 0.0;      // s, before the run begins
};
void Describe(base::Description& d, SelfHeatingConfig& c);

/// One thermal mass under constant power (lumped capacitance; Incropera and DeWitt, Fundamentals of Heat and Mass
/// Transfer, chapter 5), in K above the temperature of calibration at t (s) since the run's beginning:
///
///   ΔT(t) = ambient + rise (1 − exp(−(t + powered_for) / time_constant))
double AboveCalibration(const SelfHeatingConfig& config, double t);

}  // namespace alula::sim
