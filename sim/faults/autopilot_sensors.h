#pragma once

#include <cstdint>
#include <vector>

#include "sim/faults/injector.h"
#include "vehicles/vehicle.h"

namespace alula::sim::faults {

/// The way from the autopilot's own sensors to the autopilot, with the faults upon it.
class AutopilotSensorLine {
 public:
  /// What reaches the autopilot at a tick of what its sensors take then. Of an IMU that gives nothing the last sample
  /// stands in its register, not marked as fresh; a barometer that gives nothing is absent.
  vehicles::AutopilotSensors Pass(base::Time now, const vehicles::AutopilotSensors& taken, Injector& injector);

 private:
  struct Pending {
    stack::Measurement measurement;
    Numbers struck_by;
  };
  void Send(stack::SensorId sensor, base::Time now, decltype(stack::Measurement::data) data, Injector& injector);

  std::vector<Pending> pending_;  // the last one arrives first
  vehicles::AutopilotSensors arrived_;
  std::uint32_t seq_ = 0;
};

}  // namespace alula::sim::faults
