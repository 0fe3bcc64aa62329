#include "sim/faults/autopilot_sensors.h"

#include <algorithm>

#include "sim/faults/scope.h"

namespace alula::sim::faults {

void AutopilotSensorLine::Send(stack::SensorId sensor, base::Time now, decltype(stack::Measurement::data) data,
                               Injector& injector) {
  Pending sent{{sensor, seq_, now, now, std::move(data)}, {}};
  if (!injector.Take(sent.measurement, sent.struck_by)) return;
  const auto later = [](const Pending& a, const Pending& b) { return ArrivesBefore(b.measurement, a.measurement); };
  pending_.insert(std::upper_bound(pending_.begin(), pending_.end(), sent, later), std::move(sent));
}

vehicles::AutopilotSensors AutopilotSensorLine::Pass(base::Time now, const vehicles::AutopilotSensors& taken,
                                                     Injector& injector) {
  Send(kAutopilotImu, now, taken.imu, injector);
  if (taken.barometer) Send(kAutopilotBarometer, now, *taken.barometer, injector);
  Send(kAutopilotBattery, now, stack::BatterySample{taken.battery_voltage, 0.0}, injector);
  ++seq_;
  arrived_.imu_fresh = false;
  arrived_.barometer.reset();
  while (!pending_.empty() && pending_.back().measurement.available <= now) {
    stack::Measurement& m = pending_.back().measurement;
    injector.Arrive(m, pending_.back().struck_by);
    if (const auto* imu = std::get_if<stack::ImuSample>(&m.data)) {
      arrived_.imu = *imu;
      arrived_.imu_fresh = true;
    } else if (const auto* barometer = std::get_if<stack::BaroSample>(&m.data)) {
      arrived_.barometer = *barometer;
    } else if (const auto* battery = std::get_if<stack::BatterySample>(&m.data)) {
      arrived_.battery_voltage = battery->voltage;
    }
    pending_.pop_back();
  }
  return arrived_;
}

}  // namespace alula::sim::faults
