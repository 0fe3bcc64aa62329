#include "sim/sensors/battery_gauge.h"

#include <cmath>

namespace alula::sim {
namespace {

double Quantised(double value, double quantum) { return quantum > 0.0 ? quantum * std::round(value / quantum) : value; }

}  // namespace

void Describe(base::Description& d, BatteryGaugeConfig& c) {
  d.Field("voltage_scale", c.voltage_scale, {.meaning = "share by which voltage reads too much", .min = -1, .max = 1});
  d.Field("voltage_offset", c.voltage_offset, {.unit = "V", .meaning = "that voltage reads too much"});
  d.Field("voltage_quantum", c.voltage_quantum, {.unit = "V", .meaning = "least step of voltage; 0: none", .min = 0});
  d.Field("current_scale", c.current_scale, {.meaning = "share by which current reads too much", .min = -1, .max = 1});
  d.Field("current_offset", c.current_offset, {.unit = "A", .meaning = "that current reads too much"});
  d.Field("current_noise", c.current_noise, {.unit = "A", .meaning = "standard deviation of the current", .min = 0});
  d.Field("current_quantum", c.current_quantum, {.unit = "A", .meaning = "least step of current; 0: none", .min = 0});
}

stack::BatterySample Gauge(const BatteryGaugeConfig& config, const stack::BatterySample& truth, double voltage_noise,
                           double current_noise) {
  return {Quantised((1.0 + config.voltage_scale) * truth.voltage + config.voltage_offset + voltage_noise,
                    config.voltage_quantum),
          Quantised((1.0 + config.current_scale) * truth.current + config.current_offset + current_noise,
                    config.current_quantum)};
}

}  // namespace alula::sim
