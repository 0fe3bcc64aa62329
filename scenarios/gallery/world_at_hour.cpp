#include "scenarios/gallery/world_at_hour.h"

#include "scenarios/factories.h"

namespace alula::scenarios::gallery {

std::shared_ptr<const worlds::World> WorldAtHour(WorldConfig config, worlds::WeatherConfig::Hour hour,
                                                 std::uint64_t seed) {
  const bool obeys = std::visit(
      [hour](auto& c) {
        if constexpr (requires { c.weather.hour = hour; }) {
          if (c.weather.hour != hour) c.weather.sun_elevation.reset();  // an elevation belongs to its hour
          c.weather.hour = hour;
          return true;
        }
        if constexpr (requires { c.light.hour = hour; }) {
          c.light.hour = hour;
          return true;
        }
        return false;
      },
      config);
  const auto world = MakeWorld(config, seed);
  if (obeys || hour == worlds::WeatherConfig::Hour::kDay) return world;
  worlds::World dark = *world;
  worlds::WeatherConfig weather;
  weather.hour = hour;
  const std::vector<worlds::Lamp> lamps = dark.light.lamps;
  dark.light = worlds::DrawLight(weather, seed);
  dark.light.lamps = lamps;
  return std::make_shared<const worlds::World>(std::move(dark));
}

}  // namespace alula::scenarios::gallery
