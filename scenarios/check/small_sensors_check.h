#pragma once

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Barometer: noise, rate, how pressure falls with height, the day's offset over many seeds.
void CheckBarometer(const Rig& rig, const sim::BarometerConfig& claimed, Report& report);
/// Position reference: noise of position and attitude, delay, rate.
void CheckPositionReference(const Rig& rig, const sim::PositionReferenceConfig& claimed, Report& report);
/// Receiver of satellites: noise from fix to fix, delay, rate.
void CheckGnssReceiver(const Rig& rig, const sim::GnssReceiverConfig& claimed, Report& report);
/// Noise and rate of the battery's readings.
void CheckBattery(const Rig& rig, const sim::SensorsConfig& claimed, Report& report);

}  // namespace alula::scenarios::check
