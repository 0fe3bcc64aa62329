#include <gtest/gtest.h>

#include "base/config.h"

namespace alula::base {
namespace {

struct Rotor {
  double radius = 0.0635;
  Vec3 position = Vec3::Zero();
};
void Describe(Description& d, Rotor& c) {
  d.Field("radius", c.radius, {.unit = "m", .meaning = "propeller radius", .min = 0.01, .max = 2});
  d.Field("position", c.position, {.unit = "m", .meaning = "hub in the body frame"});
}
struct Calm {};
void Describe(Description&, Calm&) {}
struct Gusty {
  double speed = 3;
};
void Describe(Description& d, Gusty& c) { d.Field("speed", c.speed, {.unit = "m/s", .min = 0}); }
enum class Mode { kAuto, kManual };
struct Vehicle {
  std::string name = "x y";
  double mass = 0.7;
  double noise = 1.7e-4;
  Mode mode = Mode::kAuto;
  Duration delay = Milliseconds(5);
  Rate rate{30, 1};
  std::optional<double> limit;
  std::vector<Rotor> rotors;
  std::variant<Calm, Gusty> wind;
  std::vector<std::variant<Calm, Gusty>> winds;
  std::vector<double> gains{1, 2};
};
void Describe(Description& d, Vehicle& c) {
  d.Field("name", c.name);
  d.Field("mass", c.mass, {.unit = "kg", .meaning = "take-off mass", .min = 0.01, .max = 100, .required = true});
  d.Field("noise", c.noise, {.unit = "rad/s/sqrt(Hz)"});
  d.Field("mode", c.mode, {.choices = {"auto", "manual"}});
  d.Field("delay", c.delay);
  d.Field("rate", c.rate);
  d.Field("limit", c.limit, {.unit = "m"});
  d.Field("rotors", c.rotors);
  d.OneOf("wind", c.wind, {.choices = {"calm", "gusty"}});
  d.ListOf("winds", c.winds, {.choices = {"calm", "gusty"}});
  d.Field("gains", c.gains, {.unit = "1/s"});
}

TEST(ConfigSmoke, ReadsAndDumps) {
  const auto document = YamlDocument::Parse(R"(mass: {uniform: [600 g, 0.9 kg]}
noise: 1.7e-4 rad/s/√Hz
mode: manual
delay: 8 ms
rate: 30000/1001 Hz
limit: 5 inch
rotors:
  - {radius: 250 mm, position: [1, 2, 3] m}
  - position: [1 m, 20 cm, 3 m]
wind: {type: gusty, speed: 36 km/h}
winds: [{type: calm}, {type: gusty}]
gains: [3, 4] Hz
)",
                                            "a.yaml", {}, {{"rotors.1.radius", "{choice: [1 m]}"}});
  const Vehicle vehicle = ReadConfig<Vehicle>(document, 1);
  EXPECT_GT(vehicle.mass, 0.6);
  EXPECT_EQ(vehicle.rotors[0].radius, 0.25);
  EXPECT_EQ(vehicle.rotors[0].position.z(), 3);
  EXPECT_EQ(vehicle.rotors[1].radius, 1);
  EXPECT_EQ(vehicle.rate, (Rate{30000, 1001}));
  EXPECT_EQ(std::get<Gusty>(vehicle.wind).speed, 10);
  const std::string dump = DumpConfig(vehicle);
  const Vehicle again = ReadConfig<Vehicle>(YamlDocument::Parse(dump, "dump"), 2);
  EXPECT_EQ(dump, DumpConfig(again)) << dump;
  EXPECT_EQ(again.mass, vehicle.mass);
  EXPECT_FALSE(SchemaOfConfig<Vehicle>("vehicle").empty());
}

}  // namespace
}  // namespace alula::base
