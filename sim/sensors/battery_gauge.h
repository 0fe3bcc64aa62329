#pragma once

#include <cstdint>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// What a power module reads wrongly of voltage and current; by default nothing.
struct BatteryGaugeConfig {
  double voltage_scale = 0.0;    // share by which it reads too much
  double voltage_offset = 0.0;   // V
  double voltage_quantum = 0.0;  // V; 0: continuous
  double current_scale = 0.0;
  double current_offset = 0.0;   // A
  double current_noise = 0.0;    // 1σ, A
  double current_quantum = 0.0;  // A
};
void Describe(base::Description& d, BatteryGaugeConfig& c);

/// A shunt and a divider before an ADC (Texas Instruments, INA226 data sheet): y = Q[(1 + k) x + o + n].
stack::BatterySample Gauge(const BatteryGaugeConfig& config, const stack::BatterySample& truth, double voltage_noise,
                           double current_noise);

}  // namespace alula::sim
