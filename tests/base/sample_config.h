#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/config.h"

/// A made-up vehicle with a field of every kind, for the tests of the reader.
namespace alula::base::sample {

struct Rotor {
  double radius = 0.0635;
  Vec3 position = Vec3::Zero();
};
inline void Describe(Description& d, Rotor& c) {
  d.Field("radius", c.radius, {.unit = "m", .meaning = "propeller radius", .min = 0.01, .max = 2});
  d.Field("position", c.position, {.unit = "m", .meaning = "hub in the body frame"});
}

struct Calm {};
inline void Describe(Description&, Calm&) {}

struct Gusty {
  double speed = 3;
  Duration period = Milliseconds(1500);
};
inline void Describe(Description& d, Gusty& c) {
  d.Field("speed", c.speed, {.unit = "m/s", .meaning = "mean speed", .min = 0, .max = 40});
  d.Field("period", c.period, {.meaning = "of the gusts"});
}

using Wind = std::variant<Calm, Gusty>;
enum class Mode { kAuto, kManual };

struct Battery {
  double voltage = 11.1;
  int cells = 3;
};
inline void Describe(Description& d, Battery& c) {
  d.Field("voltage", c.voltage, {.unit = "V", .min = 0});
  d.Field("cells", c.cells, {.min = 1, .max = 12});
  d.Check("voltage", [&c] {
    return c.voltage > 4.4 * c.cells ? std::string("is more than 4.4 V a cell; add cells or lower it") : std::string();
  });
}

struct Vehicle {
  std::string name = "sample";
  double mass = 0.7;
  double noise = 1.7e-4;
  double field_of_view = 1.2;
  double ratio = 0.5;
  double reach = std::numeric_limits<double>::infinity();
  int count = 4;
  std::int64_t offset = -3;
  std::uint64_t key = 18446744073709551615ULL;
  bool armed = false;
  Mode mode = Mode::kAuto;
  Duration delay = Milliseconds(5);
  Rate rate{30, 1};
  Vec3 start = {0, 0, 1};
  std::optional<double> limit;
  std::optional<Battery> battery;
  std::vector<Rotor> rotors{{}, {}};
  Wind wind;
  std::vector<Wind> gusts;
  std::vector<double> gains{1, 2};
  std::vector<std::string> tags;
  std::vector<Vec3> waypoints;
  std::vector<Duration> times;
  std::string mesh;
};
inline void Describe(Description& d, Vehicle& c) {
  d.Field("name", c.name);
  d.Field("mass", c.mass, {.unit = "kg", .meaning = "take-off mass", .min = 0.01, .max = 100, .required = true});
  d.Field("noise", c.noise, {.unit = "rad/s/sqrt(Hz)"});
  d.Field("field_of_view", c.field_of_view, {.unit = "rad", .min = 0, .max = 3});
  d.Field("ratio", c.ratio, {.min = 0, .max = 1});
  d.Field("reach", c.reach, {.unit = "m", .min = 0});
  d.Field("count", c.count, {.min = 1, .max = 8});
  d.Field("offset", c.offset);
  d.Field("key", c.key);
  d.Field("armed", c.armed);
  d.Field("mode", c.mode, {.choices = {"auto", "manual"}});
  d.Field("delay", c.delay, {.meaning = "of the link", .min = 0, .max = 1});
  d.Field("rate", c.rate, {.meaning = "of the camera", .max = 1000});
  d.Field("start", c.start, {.unit = "m", .min = -100, .max = 100});
  d.Field("limit", c.limit, {.unit = "m"});
  d.Field("battery", c.battery);
  d.Field("rotors", c.rotors);
  d.OneOf("wind", c.wind, {.choices = {"calm", "gusty"}});
  d.ListOf("gusts", c.gusts, {.choices = {"calm", "gusty"}});
  d.Field("gains", c.gains, {.unit = "1/s"});
  d.Field("tags", c.tags);
  d.Field("waypoints", c.waypoints, {.unit = "m"});
  d.Field("times", c.times);
  d.Field("mesh", c.mesh, {.is_path = true});
}

inline Vehicle Read(std::string_view yaml, const std::vector<Override>& overrides = {}, std::uint64_t seed = 1) {
  return ReadConfig<Vehicle>(YamlDocument::Parse(yaml, "q.yaml", {}, overrides), seed);
}

}  // namespace alula::base::sample
