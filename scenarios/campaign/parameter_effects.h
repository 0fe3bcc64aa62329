#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scenarios/campaign/row.h"
#include "scenarios/campaign/statistics/effects.h"

namespace alula::scenarios::campaign {

/// Which parameters separate the runs that did not pass from those that did; the strongest first.
std::vector<statistics::Effect> EffectsOf(const std::vector<Row>& rows);
/// Those that chance does not explain, as a table; empty where there are none.
std::string EffectsText(const std::vector<statistics::Effect>& effects);
nlohmann::ordered_json EffectsJson(const std::vector<statistics::Effect>& effects);

}  // namespace alula::scenarios::campaign
