#include "worlds/wind_config.h"

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace alula::worlds {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

void Describe(base::Description&, CalmAir&) {}

void Describe(base::Description& d, DrydenConfig& c) {
  d.Field(
      "w20", c.w20,
      {.unit = "m/s", .meaning = "mean wind 20 ft above the ground; null: that of the mean", .min = 0.0, .max = 40.0});
  d.Field("airspeed_floor", c.airspeed_floor,
          {.unit = "m/s", .meaning = "at which turbulence passes one who hovers", .min = 0.1, .max = 20.0});
}

void Describe(base::Description& d, CosineGustConfig& c) {
  d.Field("start", c.start, {.unit = "s", .meaning = "when it begins", .min = 0.0});
  d.Field("duration", c.duration, {.unit = "s", .meaning = "how long it lasts", .min = 0.05, .max = 600.0});
  d.Field("velocity", c.velocity,
          {.unit = "m/s", .meaning = "that it adds at its middle, world axes", .min = -40.0, .max = 40.0});
}

void Describe(base::Description& d, WindConfig& c) {
  d.Field("speed", c.speed, {.unit = "m/s", .meaning = "of the mean wind", .min = 0.0, .max = 40.0});
  d.Field("direction", c.direction,
          {.unit = "rad",
           .meaning = "where the air moves to, from east to north; null: drawn",
           .min = -2.0 * kPi,
           .max = 2.0 * kPi});
  d.Field("gust_share", c.gust_share,
          {.meaning = "standard deviation of gusts per axis over the mean wind's speed", .min = 0.0, .max = 1.0});
  d.Field("gust_time", c.gust_time, {.unit = "s", .meaning = "correlation time of gusts", .min = 0.05, .max = 60.0});
  d.OneOf("turbulence", c.turbulence, {.meaning = "besides gusts", .choices = {"none", "dryden"}});
  d.Field("gusts", c.gusts, {.meaning = "single gusts of one-minus-cosine shape"});
  d.Field("shelter", c.shelter, {.meaning = "whether what stands keeps the wind off what is behind it"});
}

Wind DrawWind(const WindConfig& config, std::uint64_t seed) {
  base::RandomStream random(seed, "world/wind");
  const double drawn = random.Uniform(-kPi, kPi);
  const double direction = config.direction.value_or(drawn);
  Wind wind;
  wind.mean_W = {config.speed * std::cos(direction), config.speed * std::sin(direction), 0.0};
  wind.gust_sigma = config.speed * config.gust_share;
  wind.gust_time = config.gust_time;
  if (const auto* dryden = std::get_if<DrydenConfig>(&config.turbulence)) {
    wind.dryden = Dryden{dryden->w20.value_or(config.speed), dryden->airspeed_floor};
  }
  for (const CosineGustConfig& gust : config.gusts) wind.gusts.push_back({gust.start, gust.duration, gust.velocity});
  wind.shelter = config.shelter;
  return wind;
}

}  // namespace alula::worlds
