#include "base/config.h"

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/random.h"
#include "tests/base/sample_config.h"

namespace alula::base {
namespace {

namespace fs = std::filesystem;
using sample::Calm;
using sample::Gusty;
using sample::Mode;
using sample::Read;
using sample::Vehicle;

TEST(Config, ReadsEveryKindOfField) {
  const Vehicle v = Read(R"(
name: "a: [b] m"   # brackets in quotes are text
mass: 600 g
noise: 1.7e-4 rad/s/√Hz
field_of_view: 70 deg
ratio: 12 %
reach: inf m
count: 6
offset: -9000000000
key: 18446744073709551614
armed: true
mode: manual
delay: 8 ms
rate: 30000/1001 Hz
start: [1, 2, 3] m
limit: 5 inch
battery: {voltage: 12.6 V}
rotors:
  - {radius: 250 mm, position: [1, 2, 3] cm}
  - position: [1 m, 20 cm, -3 m]
  - {}
wind: {type: gusty, speed: 36 km/h}
gusts: [{type: calm}, {type: gusty, period: 1 min}]
gains: [3, 4] Hz
tags:
  - see [3] there
  - x
waypoints: [[0, 0, 1], [2, 0, 1]] m
times: [1 s, 2 ms]
)");
  EXPECT_EQ(v.name, "a: [b] m");
  EXPECT_EQ(v.mass, 0.6);
  EXPECT_EQ(v.noise, 1.7e-4);
  EXPECT_EQ(v.field_of_view, 70 * M_PI / 180);
  EXPECT_EQ(v.ratio, 0.12);
  EXPECT_EQ(v.count, 6);
  EXPECT_EQ(v.offset, -9'000'000'000);
  EXPECT_EQ(v.key, 18446744073709551614ULL);
  EXPECT_TRUE(v.armed);
  EXPECT_EQ(v.mode, Mode::kManual);
  EXPECT_EQ(v.delay, Milliseconds(8));
  EXPECT_EQ(v.rate, (Rate{30000, 1001}));
  EXPECT_EQ(v.start, Vec3(1, 2, 3));
  EXPECT_EQ(v.limit, 0.127);
  EXPECT_EQ(v.battery.value().voltage, 12.6);
  ASSERT_EQ(v.rotors.size(), 3u);
  EXPECT_EQ(v.rotors[0].radius, 0.25);
  EXPECT_EQ(v.rotors[0].position, Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(v.rotors[1].position, Vec3(1, 0.2, -3));
  EXPECT_EQ(std::get<Gusty>(v.wind).speed, 10);
  ASSERT_EQ(v.gusts.size(), 2u);
  EXPECT_EQ(std::get<Gusty>(v.gusts[1]).period, Milliseconds(60'000));
  EXPECT_EQ(v.gains, (std::vector<double>{3, 4}));
  EXPECT_EQ(v.tags.at(0), "see [3] there");
  EXPECT_EQ(v.waypoints.at(1), Vec3(2, 0, 1));
  EXPECT_EQ(v.times, (std::vector<Duration>{Milliseconds(1000), Milliseconds(2)}));
}

TEST(Config, KeepsDefaultsAndTakesNullForAbsent) {
  const Vehicle v = Read("mass: 1 kg\nbattery: null\nwind:\n");
  EXPECT_EQ(v.rotors.size(), 2u);
  EXPECT_FALSE(v.battery);
  EXPECT_TRUE(std::holds_alternative<Calm>(v.wind));
}

TEST(Config, DumpReadsBackToTheSameBits) {
  RandomStream random(5, "dump");
  for (int i = 0; i < 200; ++i) {
    Vehicle v;
    v.mass = random.Uniform(0.01, 100);
    v.noise = std::exp(random.Uniform(-600, 600));
    v.start = {random.Uniform(-100, 100), -0.0, random.Uniform(-1e-300, 1e-300)};
    v.key = random.Bits();
    v.delay = Nanoseconds(static_cast<std::int64_t>(random.Index(1'000'000'000)));
    v.rate = {1 + static_cast<std::int64_t>(random.Index(900)), 1 + static_cast<std::int64_t>(random.Index(90))};
    v.name = random.Uniform() < 0.5 ? "null" : "quote \" back\\slash\nline µ \x01 [1] m: #";
    v.mode = random.Index(2) == 0 ? Mode::kAuto : Mode::kManual;
    if (random.Index(2) == 0) v.limit = random.Gaussian();
    if (random.Index(2) == 0) v.battery.emplace();
    v.rotors.resize(static_cast<std::size_t>(random.Index(4)));
    for (auto& rotor : v.rotors) rotor.position = random.GaussianVec3();
    v.wind = Gusty{random.Uniform(0, 40), Nanoseconds(17)};
    v.gusts = {Calm{}, Gusty{random.Uniform(0, 40), Milliseconds(3)}};
    v.gains = {random.Gaussian(), 1e22, 5e-324};
    v.tags = {"", "plain", "~", "1", "true story", "- x"};
    v.waypoints = {random.GaussianVec3(), random.GaussianVec3()};
    v.times = {Nanoseconds(1), Milliseconds(2)};
    v.mesh = "/meshes/crate.obj";
    const std::string dump = DumpConfig(v);
    const Vehicle again = Read(dump, {}, 99);
    ASSERT_EQ(DumpConfig(again), dump);
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    ASSERT_EQ(bits(again.mass), bits(v.mass));
    ASSERT_EQ(bits(again.noise), bits(v.noise));
    for (int k = 0; k < 3; ++k) ASSERT_EQ(bits(again.start[k]), bits(v.start[k]));
    ASSERT_EQ(again.key, v.key);
    ASSERT_EQ(again.delay, v.delay);
    ASSERT_EQ(again.name, v.name);
    ASSERT_EQ(again.tags, v.tags);
    ASSERT_EQ(again.waypoints, v.waypoints);
    ASSERT_EQ(again.rate.cycles * v.rate.seconds, v.rate.cycles * again.rate.seconds);
  }
}

TEST(Config, DumpIsReadableWithUnits) {
  Vehicle v;
  v.battery.emplace();
  v.gusts = {Calm{}, Gusty{}};
  v.times = {Milliseconds(2)};
  v.rotors.resize(1);
  EXPECT_EQ(DumpConfig(v), R"(name: sample
mass: 0.7 kg
noise: 0.00017 rad/s/sqrt(Hz)
field_of_view: 1.2 rad
ratio: 0.5
reach: inf m
count: 4
offset: -3
key: 18446744073709551615
armed: false
mode: auto
delay: 5 ms
rate: 30 Hz
start: [0 m, 0 m, 1 m]
limit: null
battery:
  voltage: 11.1 V
  cells: 3
rotors:
  - radius: 0.0635 m
    position: [0 m, 0 m, 0 m]
wind:
  type: calm
gusts:
  - type: calm
  - type: gusty
    speed: 3 m/s
    period: 1500 ms
gains: [1 1/s, 2 1/s]
tags: []
waypoints: []
times:
  - 2 ms
mesh: ""
)");
}

TEST(Config, DistributionsDrawFromTheStreamOfTheirPath) {
  const char* yaml = "mass: {uniform: [600 g, 0.9 kg]}\nratio: {normal: [0.9, 0.2]}\ncount: {uniform: [1, 8]}\n";
  RandomStream stream(3, "parameter/mass");
  EXPECT_EQ(Read(yaml, {}, 3).mass, stream.Uniform(0.6, 0.9));
  // Another key changes nothing about this one.
  EXPECT_EQ(Read(std::string(yaml) + "noise: {uniform: [1, 2] rad/s/sqrt(Hz)}\n", {}, 3).mass, Read(yaml, {}, 3).mass);
  std::vector<int> counts(9);
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Vehicle v = Read(yaml, {}, seed);
    ASSERT_GE(v.mass, 0.6);
    ASSERT_LE(v.mass, 0.9);
    ASSERT_LE(v.ratio, 1.0);  // redrawn inside its range, not clamped to it
    ASSERT_NE(v.ratio, 1.0);
    sum += v.mass;
    ++counts.at(static_cast<std::size_t>(v.count));
  }
  EXPECT_NEAR(sum / 2000, 0.75, 4 * 0.3 / std::sqrt(12.0 * 2000));
  for (int i = 1; i <= 8; ++i) EXPECT_NEAR(counts[static_cast<std::size_t>(i)], 250, 4 * std::sqrt(250 * 7.0 / 8));
}

TEST(Config, DrawsAreNotedAndQuantilesTakeTheirPlace) {
  const YamlDocument document = YamlDocument::Parse(
      "mass: {uniform: [600 g, 0.9 kg]}\nratio: {normal: [0.5, 0.1]}\ncount: {uniform: [1, 8]}\n"
      "mode: {choice: [auto, manual]}\nstart: {uniform: [[0, 0, 1], [1, 2, 1]] m}\n",
      "test.yaml");
  Draws draws;
  const Vehicle plain = ReadConfig<Vehicle>(document, 7);
  const Vehicle noted = ReadConfig<Vehicle>(document, 7, &draws);
  EXPECT_EQ(DumpConfig(plain), DumpConfig(noted));
  ASSERT_EQ(draws.drawn.size(), 7U);  // the vector's three components one by one
  EXPECT_EQ(draws.drawn.at("mass").number, noted.mass);
  EXPECT_EQ(draws.drawn.at("mass").kind, "uniform");
  EXPECT_EQ(draws.drawn.at("count").value, std::to_string(noted.count));
  EXPECT_EQ(draws.drawn.at("start.1").number, noted.start.y());
  std::vector<Override> given;  // what was noted, written into the file, gives the same
  for (const auto& [path, drawn] : draws.drawn) given.push_back({path, drawn.value});
  const YamlDocument fixed = YamlDocument::Parse("start: [0, 0, 1] m\n", "fixed.yaml", {}, given);
  EXPECT_EQ(DumpConfig(ReadConfig<Vehicle>(fixed, 99)), DumpConfig(plain));

  const std::map<std::string, double> quantiles = {{"mass", 0.25}, {"ratio", 0.975}, {"count", 0.999}, {"mode", 0.6}};
  draws.quantile = [&](const std::string& path) -> std::optional<double> {
    const auto found = quantiles.find(path);
    return found == quantiles.end() ? std::nullopt : std::optional(found->second);
  };
  const Vehicle placed = ReadConfig<Vehicle>(document, 7, &draws);
  EXPECT_DOUBLE_EQ(placed.mass, 0.675);
  EXPECT_NEAR(placed.ratio, 0.5 + 0.1 * 1.959963984540054, 1e-6);  // cut off at 0 and 1, 5 sigma away
  EXPECT_EQ(placed.count, 8);
  EXPECT_EQ(draws.drawn.at("mode").number, 1.0);
  EXPECT_EQ(placed.start, plain.start);
}

TEST(Config, ChoicesAndVectorsDraw) {
  bool gusty = false, calm = false, low = false;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Vehicle v = Read(R"(
mass: {choice: [1 kg, {uniform: [2, 3] kg}]}
wind: {choice: [{type: calm}, {type: gusty, speed: 4 m/s}]}
start: {uniform: [[0, 0, 1], [1, 2, 1]] m}
waypoints: [{normal: [[0, 0, 0], [1, 1, 0]] m}]
delay: {uniform: [1 ms, 2 ms]}
mode: {choice: [auto, manual]}
)",
                           {}, seed);
    (std::holds_alternative<Gusty>(v.wind) ? gusty : calm) = true;
    low = low || v.mass == 1.0;
    EXPECT_EQ(v.start.z(), 1.0);
    EXPECT_NE(v.start.x(), v.start.y());
    EXPECT_GE(v.delay, Milliseconds(1));
    EXPECT_LE(v.delay, Milliseconds(2));
  }
  EXPECT_TRUE(gusty && calm && low);
}

TEST(Config, OverridesReachAnyKey) {
  const char* yaml = "mass: 1 kg\nrotors: [{radius: 1 m}, {radius: 1 m}]\nwind: {type: gusty, speed: 5 m/s}\n";
  EXPECT_EQ(Read(yaml, {{"mass", "2 kg"}}).mass, 2);
  EXPECT_EQ(Read(yaml, {{"rotors.1.radius", "0.5 m"}}).rotors[1].radius, 0.5);
  EXPECT_EQ(Read(yaml, {{"rotors.1.position", "[1, 2, 3] m"}}).rotors[1].position.z(), 3);
  EXPECT_EQ(Read(yaml, {{"rotors.1.position.2", "7 m"}}).rotors[1].position, Vec3(0, 0, 7));
  EXPECT_EQ(Read(yaml, {{"gains.1", "9 Hz"}}).gains, (std::vector<double>{1, 9}));
  EXPECT_EQ(Read(yaml, {{"battery.cells", "4"}}).battery.value().cells, 4);
  EXPECT_EQ(Read(yaml, {{"mass", "{uniform: [3 kg, 4 kg]}"}}).mass > 3, true);
  EXPECT_TRUE(std::holds_alternative<Calm>(Read(yaml, {{"wind.type", "calm"}}).wind));
  // The type clears the keys of the type before, whatever the order of the settings.
  const Vehicle v = Read("mass: 1 kg\n", {{"wind.speed", "7 m/s"}, {"wind.type", "gusty"}});
  EXPECT_EQ(std::get<Gusty>(v.wind).speed, 7);
  EXPECT_EQ(std::get<Gusty>(Read(yaml, {{"wind", "{speed: 8 m/s}"}}).wind).speed, 8);
}

class Extends : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("alula_extends_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "catalog");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void Write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Vehicle Load(const std::string& name, const std::vector<Override>& overrides = {}) {
    return ReadConfig<Vehicle>(YamlDocument::Load(folder_ / name, {folder_ / "catalog"}, overrides), 1);
  }
  std::string Error(const std::string& name, const std::vector<Override>& overrides = {}) {
    try {
      Load(name, overrides);
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
      return text;
    }
    return "no error";
  }
  fs::path folder_;
};

TEST_F(Extends, MergesMapsAndReplacesTheRest) {
  Write("catalog/heavy.yaml", "mass: 3 kg\nbattery: {voltage: 12 V, cells: 4}\ngains: [1, 2, 3] Hz\n");
  Write("catalog/wind.yaml", "type: gusty\nspeed: 9 m/s\nperiod: 2 s\n");
  Write("b.yaml", "extends: heavy\nbattery: {cells: 5}\nmass: {uniform: [1, 2] kg}\n");
  Write("a.yaml", "extends: b.yaml\ngains: [4 Hz]\nwind: {extends: wind, speed: 1 m/s}\nmass: {normal: [5, 0] kg}\n");
  const Vehicle v = Load("a.yaml");
  EXPECT_EQ(v.mass, 5);
  EXPECT_EQ(v.battery.value().cells, 5);
  EXPECT_EQ(v.battery.value().voltage, 12);
  EXPECT_EQ(v.gains, std::vector<double>{4});
  EXPECT_EQ(std::get<Gusty>(v.wind).speed, 1);
  EXPECT_EQ(std::get<Gusty>(v.wind).period, Milliseconds(2000));
}

TEST_F(Extends, AnOverrideSwapsWhatAMapBuildsOn) {
  Write("catalog/light.yaml", "mass: 1 kg\nbattery: {cells: 1, voltage: 4 V}\n");
  Write("catalog/heavy.yaml", "mass: 3 kg\nbattery: {cells: 6}\n");
  Write("catalog/wind.yaml", "type: gusty\nspeed: 9 m/s\n");
  Write("a.yaml", "extends: light\nname: mine\n");
  Write("b.yaml", "extends: a.yaml\n");
  EXPECT_EQ(Load("b.yaml", {{"extends", "heavy"}}).mass, 3);
  EXPECT_EQ(Load("b.yaml", {{"extends", "heavy"}}).name, "sample");
  EXPECT_EQ(std::get<Gusty>(Load("b.yaml", {{"wind.extends", "wind"}}).wind).speed, 9);
  EXPECT_EQ(std::get<Gusty>(Load("b.yaml", {{"wind.extends", "wind"}, {"wind.speed", "2 m/s"}}).wind).speed, 2);
}

TEST_F(Extends, TheSameFileMayBeUsedTwice) {
  Write("catalog/rotor.yaml", "radius: 1 m\n");
  Write("a.yaml", "mass: 1 kg\nrotors: [{extends: rotor}, {extends: rotor, position: [1, 0, 0] m}]\n");
  EXPECT_EQ(Load("a.yaml").rotors.at(1).radius, 1);
}

TEST_F(Extends, SaysWhatIsWrong) {
  Write("catalog/heavy.yaml", "mass: 3 kg\nbatery: {}\n");
  Write("circle_a.yaml", "extends: circle_b.yaml\n");
  Write("circle_b.yaml", "mass: 1 kg\nextends: circle_a.yaml\n");
  Write("self.yaml", "mass: 1 kg\nwind: {extends: self.yaml}\n");
  Write("typo.yaml", "extends: haevy\n");
  Write("gone.yaml", "extends: ./gone/x.yaml\n");
  Write("list.yaml", "- 1\n");
  Write("on_list.yaml", "extends: list.yaml\n");
  Write("map.yaml", "extends: {a: 1}\n");
  Write("below.yaml", "extends: heavy\n");
  EXPECT_EQ(Error("circle_a.yaml"),
            "circle_a.yaml:1:10: extends: goes round in a circle: circle_a.yaml → circle_b.yaml → circle_a.yaml");
  EXPECT_EQ(Error("self.yaml"), "self.yaml:2:17: extends: goes round in a circle: self.yaml → self.yaml");
  EXPECT_EQ(Error("typo.yaml"), "typo.yaml:1:10: extends: there is no `haevy` in the catalogs; did you mean `heavy`?");
  EXPECT_EQ(Error("gone.yaml"), "gone.yaml:1:10: extends: there is no file `gone/x.yaml`");
  EXPECT_EQ(Error("on_list.yaml"), "list.yaml:1:1: is a list; `extends` wants a file with a map");
  EXPECT_EQ(Error("map.yaml"), "map.yaml:1:10: extends: is a map; a file or a catalog name is wanted");
  EXPECT_EQ(Error("below.yaml"), "catalog/heavy.yaml:2:1: batery: unknown key; did you mean `battery`?");
  EXPECT_EQ(Error("nowhere.yaml"), "nowhere.yaml: cannot be read; is the name right?");
  EXPECT_EQ(Error("catalog"), "catalog: is a folder; a YAML file is wanted");
  EXPECT_EQ(Error("list.yaml"), "list.yaml:1:1: is a list; a map of keys is wanted");
}

TEST_F(Extends, PathsStartAtTheFileThatStatesThem) {
  Write("catalog/heavy.yaml", "mass: 3 kg\nmesh: meshes/crate.obj\n");
  Write("a.yaml", "extends: heavy\n");
  EXPECT_EQ(Load("a.yaml").mesh, (folder_ / "catalog/meshes/crate.obj").string());
  EXPECT_EQ(Load("a.yaml", {{"mesh", "/x.obj"}}).mesh, "/x.obj");
}

TEST(Schema, IsValidJsonThatNamesEveryField) {
  const auto schema = nlohmann::json::parse(SchemaOfConfig<Vehicle>("vehicle"));
  EXPECT_EQ(schema["title"], "vehicle");
  EXPECT_FALSE(schema["additionalProperties"]);
  for (const char* key : {"mass", "rotors", "wind", "gusts", "battery"}) {
    EXPECT_TRUE(schema["properties"].contains(key)) << key;
  }
  EXPECT_EQ(schema["properties"]["wind"]["anyOf"].size(), 2u);
  EXPECT_TRUE(schema["properties"]["gusts"]["items"]["anyOf"][1]["properties"].contains("speed"));
  EXPECT_EQ(schema["properties"]["mass"]["description"], "take-off mass [kg], at least 0.01 kg, at most 100 kg");
}

}  // namespace
}  // namespace alula::base
