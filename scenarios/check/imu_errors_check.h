#pragma once

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// What sim/sensors/imu_errors.h makes wrong, where the unit claims errors. The unit is shaken along known sines
/// (scale, axes, g-sensitivity by least squares of its readings against w_I and f_I; quanta as the least step between
/// readings), shaken in an oven 20 K above and below the temperature of calibration (slopes), left to warm up beside
/// the same unit that stays cool (rise and time constant), and stands beside one turning rotor (harmonics).
void CheckImuErrors(const Rig& rig, const sim::ImuConfig& claimed, Report& report);

}  // namespace alula::scenarios::check
