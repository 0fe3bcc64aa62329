#pragma once

#include <string>

#include "sim/faults/fault.h"
#include "sim/sensors/suite.h"
#include "worlds/world.h"

namespace alula::sim::faults {

// The autopilot's own sensors. They have no place in a stack's calibration; these ids are theirs among the faults.
inline constexpr stack::SensorId kAutopilotImu{60001}, kAutopilotBarometer{60002}, kAutopilotBattery{60003};

/// What a simulation of these parts has that may break.
Scope ScopeOf(const SensorsConfig& sensors, const vehicles::VehicleModel& vehicle, const worlds::World& world,
              const std::string& vehicle_id, bool autopilot, bool stack);

}  // namespace alula::sim::faults
