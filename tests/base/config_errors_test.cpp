#include <gtest/gtest.h>

#include "base/config.h"
#include "base/error.h"
#include "tests/base/sample_config.h"

/// Bad files and the exact line that a user reads.
namespace alula::base {
namespace {

std::string Message(const std::string& yaml, const std::vector<Override>& overrides = {}) {
  try {
    sample::Read(yaml, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Case {
  const char* yaml;
  const char* message;
};

TEST(ConfigErrors, SayWhereWhatAndTheMend) {
  const Case cases[] = {
      {"{}", "q.yaml:1:1: mass: is missing; add it (take-off mass)"},
      {"mass: 0.75", "q.yaml:1:7: mass: `0.75` has no unit; a mass is wanted, for example `0.75 kg`"},
      {"mass: 0.75 m", "q.yaml:1:7: mass: `0.75 m` is a length; a mass is wanted, for example `0.75 kg`"},
      {"mass: 0.75 kilos",
       "q.yaml:1:7: mass: `0.75 kilos` has the unknown unit `kilos`; a mass is wanted, for example `0.75 kg`"},
      {"mass: heavy", "q.yaml:1:7: mass: `heavy` is not a number; a mass is wanted, for example `1 kg`"},
      {"mass:", "q.yaml:1:1: mass: has no value; a number is wanted"},
      {"mass: [1 kg]", "q.yaml:1:7: mass: is a list; a number is wanted"},
      {"mass: 200 kg", "q.yaml:1:7: mass: `200 kg` is out of range; it must lie between 0.01 kg and 100 kg"},
      {"mass: nan kg", "q.yaml:1:7: mass: `nan kg` is not a finite number; a mass is wanted, for example `1 kg`"},
      {"mass: inf kg", "q.yaml:1:7: mass: `inf kg` is not a finite number; a mass is wanted, for example `1 kg`"},
      {"mass: 1e999 kg", "q.yaml:1:7: mass: `1e999 kg` is too large or too small for a number"},
      {"masss: 1 kg", "q.yaml:1:1: masss: unknown key; did you mean `mass`?"},
      {"mass: 1 kg\nmass: 2 kg", "q.yaml:2:1: mass: is given twice; keep one"},
      {"mass: 1 kg\nratio: 3 m", "q.yaml:2:8: ratio: `3 m` is a length; a plain number is wanted, for example `3`"},
      {"mass: 1 kg\nratio: 2", "q.yaml:2:8: ratio: `2` is out of range; it must lie between 0 and 1"},
      {"mass: 1 kg\nfield_of_view: 70",
       "q.yaml:2:16: field_of_view: `70` has no unit; an angle is wanted, for example `70 deg`"},
      {"mass: 1 kg\nfield_of_view: 200 deg",
       "q.yaml:2:16: field_of_view: `200 deg` is out of range; it must lie between 0 rad and 3 rad"},
      {"mass: 1 kg\nnoise: 1.7e-4 rad/s",
       "q.yaml:2:8: noise: `1.7e-4 rad/s` is an angular rate; a quantity in rad/s/sqrt(Hz) is wanted, for example "
       "`1.7e-4 rad/s/sqrt(Hz)`"},
      {"mass: 1 kg\nreach: -1 m", "q.yaml:2:8: reach: `-1 m` is out of range; it must be at least 0 m"},
      {"mass: 1 kg\ncount: 2.5", "q.yaml:2:8: count: `2.5` is not a whole number; write, for example, `3`"},
      {"mass: 1 kg\ncount: 9", "q.yaml:2:8: count: `9` is out of range; it must lie between 1 and 8"},
      {"mass: 1 kg\ncount: 99999999999999999999",
       "q.yaml:2:8: count: `99999999999999999999` is too large; a whole number is wanted"},
      {"mass: 1 kg\ncount: 3 m", "q.yaml:2:8: count: `3 m` is a length; a plain number is wanted, for example `3`"},
      {"mass: 1 kg\nkey: -1", "q.yaml:2:6: key: `-1` is not a whole number of zero or more; write, for example, `3`"},
      {"mass: 1 kg\narmed: yes", "q.yaml:2:8: armed: `yes` is neither `true` nor `false`"},
      {"mass: 1 kg\nmode: automatic",
       "q.yaml:2:7: mode: `automatic` is none of the choices; did you mean `auto`? There are auto, manual"},
      {"mass: 1 kg\nmode: sporty", "q.yaml:2:7: mode: `sporty` is none of the choices; choose one of auto, manual"},
      {"mass: 1 kg\ndelay: 8", "q.yaml:2:8: delay: `8` has no unit; a time is wanted, for example `8 s`"},
      {"mass: 1 kg\ndelay: 8 m", "q.yaml:2:8: delay: `8 m` is a length; a time is wanted, for example `8 s`"},
      {"mass: 1 kg\ndelay: 3 s", "q.yaml:2:8: delay: `3 s` is out of range; it must lie between 0 s and 1 s"},
      {"mass: 1 kg\nrate: 30", "q.yaml:2:7: rate: `30` has no unit; a frequency is wanted, for example `30 Hz`"},
      {"mass: 1 kg\nrate: 50 ms", "q.yaml:2:7: rate: `50 ms` is a time; a frequency is wanted, for example `50 Hz`"},
      {"mass: 1 kg\nrate: 0 Hz", "q.yaml:2:7: rate: `0 Hz` is no frequency above zero"},
      {"mass: 1 kg\nrate: 5 kHz", "q.yaml:2:7: rate: `5 kHz` is out of range; it must be at most 1000 Hz"},
      {"mass: 1 kg\nrate: fast",
       "q.yaml:2:7: rate: `fast` is not a frequency; write, for example, `30 Hz` or `30000/1001 Hz`"},
      {"mass: 1 kg\nstart: 3 m", "q.yaml:2:8: start: is `3 m`; a list of three is wanted, for example `[0, 0, 1] m`"},
      {"mass: 1 kg\nstart: [1, 2] m",
       "q.yaml:2:8: start: is 2 values; a list of three is wanted, for example `[0, 0, 1] m`"},
      {"mass: 1 kg\nstart: [1 m, 2, 3 m]",
       "q.yaml:2:14: start.1: `2` has no unit; a length is wanted, for example `2 m`"},
      {"mass: 1 kg\nstart: [1, 2, 3] s", "q.yaml:2:9: start.0: `1 s` is a time; a length is wanted, for example `1 m`"},
      {"mass: 1 kg\nstart: [1 m, 2 m, 300 m]",
       "q.yaml:2:19: start.2: `300 m` is out of range; it must lie between -100 m and 100 m"},
      {"mass: 1 kg\nbattery: {voltage: 20 V}",
       "q.yaml:2:20: battery.voltage: is more than 4.4 V a cell; add cells or lower it"},
      {"mass: 1 kg\nbattery: {cell: 3}", "q.yaml:2:11: battery.cell: unknown key; did you mean `cells`?"},
      {"mass: 1 kg\nbattery: 3", "q.yaml:2:10: battery: is `3`; a map of keys is wanted"},
      {"mass: 1 kg\nrotors: {radius: 1 m}", "q.yaml:2:9: rotors: is a map; a list of entries is wanted"},
      {"mass: 1 kg\nrotors:\n  - radius: 1 m\n  - radios: 1 m",
       "q.yaml:4:5: rotors.1.radios: unknown key; did you mean `radius`?"},
      {"mass: 1 kg\nrotors: [{radius: 1 mm}]",
       "q.yaml:2:19: rotors.0.radius: `1 mm` is out of range; it must lie between 0.01 m and 2 m"},
      {"mass: 1 kg\nwind: {type: windy}",
       "q.yaml:2:14: wind.type: `windy` is none of the choices; choose one of calm, gusty"},
      {"mass: 1 kg\nwind: {type: calm, speed: 3 m/s}", "q.yaml:2:20: wind.speed: unknown key; known keys: type"},
      {"mass: 1 kg\nwind: gusty", "q.yaml:2:7: wind: is `gusty`; a map with the key `type` is wanted"},
      {"mass: 1 kg\ngusts: [{speed: 3 m/s}]", "q.yaml:2:9: gusts.0.type: is missing; choose one of calm, gusty"},
      {"mass: 1 kg\ntags: x", "q.yaml:2:7: tags: is `x`; a list of texts is wanted"},
      {"mass: 1 kg\ngains: [1 Hz, 2]",
       "q.yaml:2:15: gains.1: `2` has no unit; a frequency is wanted, for example `2 1/s`"},
      {"mass: {uniform: [2 kg, 1 kg]}", "q.yaml:1:17: mass: `uniform` wants the lowest value first"},
      {"mass: {uniform: [1 kg]}", "q.yaml:1:17: mass: `uniform` wants [lowest, highest]"},
      {"mass: {uniform: [1 kg, 200 kg]}",
       "q.yaml:1:24: mass: `200 kg` is out of range; it must lie between 0.01 kg and 100 kg"},
      {"mass: {normal: [1 kg, -1 kg]}", "q.yaml:1:23: mass: a standard deviation cannot be negative"},
      {"mass: {choice: []}", "q.yaml:1:16: mass: `choice` wants a list of at least one value"},
      {"mass: {choice: [1 kg, 2 m]}", "q.yaml:1:23: mass: `2 m` is a length; a mass is wanted, for example `2 kg`"},
      {"mass: {uniforn: [1 kg, 2 kg]}",
       "q.yaml:1:7: mass: is a map; a number, {uniform: …}, {normal: …} or {choice: …} is wanted"},
      {"mass: 1 kg\nname: {normal: [1, 2]}", "q.yaml:2:7: name: is a map; a text is wanted"},
      {"mass: [1 kg", "q.yaml:1:1: is not valid YAML: end of sequence flow not found"},
      {"mass: 1 kg\n\tname: x", "q.yaml:2:1: is not valid YAML: illegal tab when looking for indentation"},
      {"mass: 1 kg\n? [a, b]\n: 3", "q.yaml:2:3: a key must be a word"},
      {"mass: &a [*a]", "q.yaml:1:7: is nested deeper than 64 levels"},
      {"a: 1\n---\nb: 2",
       "q.yaml:1:1: is more than one YAML document, or something stands behind its end; one is wanted"},
      {",a: 1", "q.yaml:1:1: is more than one YAML document, or something stands behind its end; one is wanted"},
      {"3", "q.yaml:1:1: is `3`; a map of keys is wanted"},
      {"completely_different: 1",
       "q.yaml:1:1: completely_different: unknown key; known keys: name, mass, noise, field_of_view, ratio, reach, "
       "count, offset, key, armed, mode, delay, rate, start, limit, battery, …"},
      {"mass: 1 kg\nname: [1, 2", "q.yaml:2:1: is not valid YAML: end of sequence flow not found"},
  };
  for (const Case& c : cases) EXPECT_EQ(Message(c.yaml), c.message) << c.yaml;
}

TEST(ConfigErrors, OfOverridesNameTheSetting) {
  const struct {
    Override setting;
    const char* message;
  } cases[] = {
      {{"masss", "2 kg"}, "--set masss=2 kg: masss: unknown key; did you mean `mass`?"},
      {{"mass", "2 m"}, "--set mass=2 m: mass: `2 m` is a length; a mass is wanted, for example `2 kg`"},
      {{"rotors.2.radius", "1 m"}, "--set rotors.2.radius=1 m: rotors.2: the list has the elements 0 to 1"},
      {{"rotors.1.radios", "1 m"}, "--set rotors.1.radios=1 m: rotors.1.radios: unknown key; did you mean `radius`?"},
      {{"tags.0", "x"}, "--set tags.0=x: tags.0: the list is empty"},
      {{"battery.voltage.x", "1"},
       "--set battery.voltage.x=1: battery.voltage.x: `battery.voltage` is `4 V`, which has no keys"},
      {{"name.x", "1"}, "--set name.x=1: name.x: `name` is `x`, which has no keys"},
      {{"mass..x", "1"}, "--set mass..x=1: names no key; write --set path.to.key=value"},
      {{"", "1"}, "--set =1: names no key; write --set path.to.key=value"},
      {{"name", "[1"}, "--set name=[1: is not valid YAML: end of sequence flow not found"},
      {{"wind.type", "windy"},
       "--set wind.type=windy: wind.type: `windy` is none of the choices; choose one of calm, gusty"},
      {{"wind.extends", "nothing"},
       "--set wind.extends=nothing: extends: there is no `nothing` in the catalogs; there are no names here"},
  };
  for (const auto& c : cases)
    EXPECT_EQ(Message("mass: 1 kg\nname: x\nbattery: {voltage: 4 V}", {c.setting}), c.message);
}

}  // namespace
}  // namespace alula::base
