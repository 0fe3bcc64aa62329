#pragma once

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Magnetometer: rate and noise at rest; hard iron over many seeds; all nine numbers of soft iron and mount, the field
/// of the battery's current and the quantum from tumbling slowly in Earth's field, without current and with; saturation
/// in a coil.
void CheckMagnetometer(const Rig& rig, const sim::MagnetometerConfig& claimed, Report& report);

}  // namespace alula::scenarios::check
