#pragma once

#include <cstdint>
#include <memory>

#include "scenarios/scenario.h"
#include "worlds/weather.h"

namespace alula::scenarios::gallery {

/// The world of a seed at an hour: as its own `weather` or `light` key makes it where it has one; else its light is
/// replaced by that of an hour under a clear sky.
std::shared_ptr<const worlds::World> WorldAtHour(WorldConfig config, worlds::WeatherConfig::Hour hour,
                                                 std::uint64_t seed);

}  // namespace alula::scenarios::gallery
