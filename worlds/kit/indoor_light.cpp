#include "worlds/kit/indoor_light.h"

#include <string>

namespace alula::worlds {

using Hour = WeatherConfig::Hour;
using Lamps = IndoorLightConfig::Lamps;

void Describe(base::Description& d, IndoorLightConfig& c) {
  d.Field("hour", c.hour, {.meaning = "outside: day, dusk or night", .choices = {"day", "dusk", "night"}});
  d.Field("lamps", c.lamps,
          {.meaning = "all lamps, emergency lamps alone, or none; null: dim at night, else on",
           .choices = {"on", "dim", "off"}});
}

Lamps LampsAt(const IndoorLightConfig& config) {
  return config.lamps.value_or(config.hour == Hour::kNight ? Lamps::kDim : Lamps::kOn);
}

Light MakeLight(const IndoorLightConfig& config, const RoomLight& room) {
  constexpr double kDaylight[] = {1.0, 0.25, 0.004};
  constexpr float kSky[] = {1.1F, 0.5F, 0.04F};  // as displayed
  constexpr double kDimScattered = 0.02;
  const auto hour = static_cast<std::size_t>(config.hour);
  const Lamps lamps = LampsAt(config);
  Light light;
  light.to_sun_W = room.to_overhead.normalized();
  light.sun = lamps == Lamps::kOn ? static_cast<float>(room.overhead) : 0.0F;
  const double scattered = lamps == Lamps::kOn ? room.scattered : lamps == Lamps::kDim ? kDimScattered : 0.0;
  light.ambient = static_cast<float>(room.daylight * kDaylight[hour] + scattered);
  light.sky = room.window;
  light.sky_brightness = kSky[hour];
  if (lamps == Lamps::kDim) light.lamps = room.emergency;
  return light;
}

void AddEmergencyLamps(World& world, const RoomLight& room, int material) {
  int number = 0;
  for (const Lamp& lamp : room.emergency) {
    Object ball{"emergency_lamp" + std::to_string(number++), geometry::Sphere{kLampRadius}, {}, material};
    ball.X_WO.p = lamp.position + base::Vec3(0.0, 0.0, 2.0 * kLampRadius);
    ball.casts_shadow = false;
    world.objects.push_back(ball);
  }
}

}  // namespace alula::worlds
