#pragma once

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Barometer: drift (sigma and correlation time of a long record without white noise), wind (a fan along each axis) and
/// the rotors' cushion (a floor below turning rotors), each against the same barometer in still air. Only what is
/// claimed or built is looked at.
void CheckBarometerErrors(const Rig& rig, const sim::BarometerConfig& claimed, Report& report);

/// Satellites: sigmas and correlation time of the wandering error, share of fixes lost by chance, planned outages, and
/// that no attitude is claimed.
void CheckGnss(const Rig& rig, const sim::PositionReferenceConfig& claimed, Report& report);
void CheckGnss(const Rig& rig, const sim::GnssReceiverConfig& claimed, Report& report);

/// Scale and offset of the battery's gauge from two loads, its quanta, the current's noise.
void CheckBatteryGauge(const Rig& rig, const sim::SensorsConfig& claimed, Report& report);

}  // namespace alula::scenarios::check
