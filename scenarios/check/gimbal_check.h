#pragma once

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// One gimbal on a body that stands still, read by its encoders: lag, highest speed, stops, encoder noise, rate; of a
/// stabilised one the error of its horizon over many seeds.
void CheckGimbal(const Rig& rig, int gimbal, const sim::GimbalConfig& claimed, Report& report);

}  // namespace alula::scenarios::check
