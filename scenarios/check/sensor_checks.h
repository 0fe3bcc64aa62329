#pragma once

#include <functional>
#include <string>

#include "scenarios/check/rig.h"
#include "scenarios/check/row.h"

namespace alula::scenarios::check {

/// Told what is being measured.
using Told = std::function<void(const std::string& what)>;

/// Measures every sensor of the rig and compares with what `claimed` says that they are. The command gives the same
/// configuration twice; a test gives another one, which must be found out.
Report CheckSensors(const Rig& rig, const sim::SensorsConfig& claimed, const Told& told);

}  // namespace alula::scenarios::check
