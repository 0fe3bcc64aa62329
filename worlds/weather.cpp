#include "worlds/weather.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace alula::worlds {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

/// What an hour allows, and how bright it is.
struct HourTraits {
  const char* name;
  double elevation_min, elevation_max;  // rad, of the sun or the moon
  double direct, scattered;             // factors on the light of a clear day
  float sky_brightness;                 // as displayed
  Eigen::Vector3f sky;                  // clear
};
const std::array<HourTraits, 3>& Hours() {
  static const std::array<HourTraits, 3> hours{{
      {"day", 15.0 * kDegree, 70.0 * kDegree, 1.0, 1.0, 1.0F, {0.55F, 0.70F, 0.92F}},
      {"dusk", 1.0 * kDegree, 8.0 * kDegree, 0.35, 0.35, 0.75F, {0.72F, 0.58F, 0.55F}},
      {"night", 20.0 * kDegree, 60.0 * kDegree, 0.005, 0.007, 0.06F, {0.30F, 0.36F, 0.55F}},
  }};
  return hours;
}
const HourTraits& TraitsOf(const WeatherConfig& weather) { return Hours()[static_cast<std::size_t>(weather.hour)]; }

const Eigen::Vector3f kOvercastSky{0.72F, 0.74F, 0.77F};

}  // namespace

void Describe(base::Description& d, WeatherConfig& c) {
  d.Field("hour", c.hour, {.meaning = "day, dusk, or night under the moon", .choices = {"day", "dusk", "night"}});
  d.Field("sun_elevation", c.sun_elevation,
          {.unit = "rad",
           .meaning = "of the sun, at night the moon, above the horizon; null: drawn as the hour allows",
           .min = 0.5 * kDegree,
           .max = 0.5 * kPi});
  d.Field("sun_azimuth", c.sun_azimuth,
          {.unit = "rad",
           .meaning = "where it stands, from east to north; null: drawn",
           .min = -2.0 * kPi,
           .max = 2.0 * kPi});
  d.Field("cloud", c.cloud, {.meaning = "share of the sky that is covered", .min = 0.0, .max = 1.0});
  d.Field("fog", c.fog, {.meaning = "even fog; null: none"});
  d.Field("wind", c.wind, {.meaning = "moving air"});
  d.Check("sun_elevation", [&c]() -> std::string {
    if (!c.sun_elevation || c.hour == WeatherConfig::Hour::kNight) return {};
    const bool high = *c.sun_elevation > 10.0 * kDegree;
    if (c.hour == WeatherConfig::Hour::kDusk && high) return "must be at most 10 deg at dusk; or set hour: day";
    if (c.hour == WeatherConfig::Hour::kDay && *c.sun_elevation < 5.0 * kDegree) {
      return "must be at least 5 deg by day; or set hour: dusk";
    }
    return {};
  });
  d.Check("fog", [&c] {
    return !c.fog || c.wind.speed <= 10.0 || c.fog->visibility > 1000.0
               ? std::string()
               : std::string("contradicts a wind above 10 m/s, which blows it away; drop one of them");
  });
}

Light DrawLight(const WeatherConfig& weather, std::uint64_t seed) {
  base::RandomStream random(seed, "world/light");
  const HourTraits& hour = TraitsOf(weather);
  const double drawn_elevation = random.Uniform(hour.elevation_min, hour.elevation_max);
  const double drawn_azimuth = random.Uniform(-kPi, kPi);
  const double elevation = weather.sun_elevation.value_or(drawn_elevation);
  const double azimuth = weather.sun_azimuth.value_or(drawn_azimuth);
  const double air = 1.0 / std::sin(std::min(elevation + 3.0 * kDegree, 0.5 * kPi));
  const double cloud = weather.cloud;

  Light light;
  light.to_sun_W = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                    std::sin(elevation)};
  light.sun = static_cast<float>(0.75 * hour.direct * (1.0 - 0.95 * cloud) * std::exp(-0.12 * (air - 1.0)));
  light.ambient = static_cast<float>(hour.scattered * (0.35 + 0.20 * cloud));
  light.sky = hour.sky +
              static_cast<float>(cloud) * (kOvercastSky.cwiseProduct(hour.sky / hour.sky.maxCoeff()) - hour.sky) * 0.7F;
  light.sky_brightness = hour.sky_brightness;
  light.fog = weather.fog;
  return light;
}

}  // namespace alula::worlds
