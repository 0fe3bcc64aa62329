#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/describe.h"
#include "worlds/wind_config.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Light and wind of an outdoor world at an hour, under clouds, with fog and lamps. What is absent is drawn from the
/// seed within what the hour allows; every key may be a distribution.
struct WeatherConfig {
  enum class Hour { kDay, kDusk, kNight };

  Hour hour = Hour::kDay;
  std::optional<double> sun_elevation{};  // rad; at night the moon's. Day 15–70°, dusk 1–8°, night 20–60°
  std::optional<double> sun_azimuth{};    // rad, from east to north
  double cloud = 0.2;                     // share of the sky that is covered; at 1 nothing casts a shadow
  std::optional<Fog> fog{};
  WindConfig wind{.speed = 1.5, .gust_share = 0.2};
};
void Describe(base::Description& d, WeatherConfig& c);

/// Stream "world/light" of the seed; DrawWind (wind_config.h) draws the wind.
///
/// One unit of light shows a texture at its own value. Clear noon gives 0.75 directly and 0.35 from the sky; with the
/// covered share c of the sky the direct light keeps (1 − 0.95 c) and the sky's grows to 0.55 as scattered light
/// replaces it. The direct light of a low sun passes more air: times exp(−0.12 (m − 1)), m = 1 / sin(elevation + 3°)
/// (Beer–Lambert, clear air). Dusk: all of it times 0.35, the sky reddish. Night: the moon at 0.004, the sky 0.0025.
Light DrawLight(const WeatherConfig& weather, std::uint64_t seed);

/// Whether lamps are lit.
inline bool IsDark(const WeatherConfig& weather) { return weather.hour != WeatherConfig::Hour::kDay; }

}  // namespace alula::worlds
