#include "worlds/lighting.h"

#include <string>

#include "base/error.h"

namespace alula::worlds {
namespace {

constexpr double kPi = 3.1415926536;

void Expect(bool good, std::string_view whose, const char* what) {
  if (!good) throw base::InputError(std::string(whose) + ": " + what);
}

bool IsColour(const base::Vec3& c) { return c.allFinite() && c.minCoeff() >= 0.0 && c.maxCoeff() <= 1.0; }

std::string Wrong(const base::Vec3& colour) {
  return IsColour(colour) ? std::string() : std::string("each channel must be in [0, 1]");
}

}  // namespace

void Describe(base::Description& d, Fog& c) {
  d.Field("visibility", c.visibility,
          {.unit = "m", .meaning = "where a black thing keeps 2 % of its contrast", .min = 1.0, .max = 100'000.0});
  d.Field("height", c.height,
          {.unit = "m", .meaning = "of the layer through which the sky is seen", .min = 0.0, .max = 10'000.0});
  d.Field("colour", c.colour, {.meaning = "of the fog as displayed, red, green, blue in [0, 1]"});
  d.Check("colour", [&c] { return Wrong(c.colour); });
}

void Describe(base::Description& d, Lamp& c) {
  d.Field("position", c.position, {.unit = "m", .meaning = "where it is"});
  d.Field("direction", c.direction, {.meaning = "where a spot shines"});
  d.Check("direction", [&c] { return c.direction.norm() > 1e-9 ? std::string() : std::string("must not be 0"); });
  d.Field(
      "cone", c.cone,
      {.unit = "rad", .meaning = "half angle where a spot's light ends; pi shines all round", .min = 0.01, .max = kPi});
  d.Field("softness", c.softness,
          {.meaning = "share of the cone over which a spot's light fades", .min = 0.001, .max = 1.0});
  d.Field("intensity", c.intensity,
          {.meaning = "light at 1 m; 1 shows a texture at its own value", .min = 0.0, .max = 1e6});
  d.Field("colour", c.colour, {.meaning = "share by channel, red, green, blue in [0, 1]"});
  d.Check("colour", [&c] { return Wrong(c.colour); });
  d.Field("range", c.range,
          {.unit = "m", .meaning = "where its light has faded to nothing", .min = 0.1, .max = 1000.0});
}

void Check(const Fog& fog, std::string_view whose) {
  Expect(fog.visibility >= 1.0 && fog.visibility <= 1e5, whose, "the fog's visibility must be in [1, 100000] m");
  Expect(fog.height >= 0.0 && fog.height <= 1e4, whose, "the fog's height must be in [0, 10000] m");
  Expect(IsColour(fog.colour), whose, "each channel of the fog's colour must be in [0, 1]");
}

void Check(const Lamp& lamp, std::string_view whose) {
  Expect(lamp.position.allFinite(), whose, "the lamp's position must be finite");
  Expect(lamp.direction.allFinite() && lamp.direction.norm() > 1e-9, whose, "the lamp's direction must not be 0");
  Expect(lamp.cone >= 0.01 && lamp.cone <= kPi, whose, "the lamp's cone must be in [0.01, pi] rad");
  Expect(lamp.softness >= 0.001 && lamp.softness <= 1.0, whose, "the lamp's softness must be in [0.001, 1]");
  Expect(lamp.intensity >= 0.0 && lamp.intensity <= 1e6, whose, "the lamp's intensity must be in [0, 1e6]");
  Expect(IsColour(lamp.colour), whose, "each channel of the lamp's colour must be in [0, 1]");
  Expect(lamp.range >= 0.1 && lamp.range <= 1000.0, whose, "the lamp's range must be in [0.1, 1000] m");
}

}  // namespace alula::worlds
