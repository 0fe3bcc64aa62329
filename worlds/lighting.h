#pragma once

#include "base/describe.h"
#include "base/frames.h"

namespace alula::worlds {

/// Even fog: light from distance r along the ray comes through by exp(−β r), β = ln(1 / 0.02) / visibility (Koschmieder
/// 1924: at the visibility a black thing keeps 2 % of contrast), and the fog's own light fills in the rest. The sky is
/// seen through a layer of `height`: r = height / sin(elevation).
struct Fog {
  double visibility = 100.0;            // m
  double height = 50.0;                 // m, of the layer above the camera
  base::Vec3 colour{0.74, 0.76, 0.78};  // as displayed
};
void Describe(base::Description& d, Fog& c);

/// A small lamp. At distance r, seen at an angle whose cosine to `direction` is c, it gives a surface that faces it
///   intensity · colour · s(t)² (3 − 2 s(t)) · (1 − (r / range)⁴)² / r²,  t = (c − cos cone) / (softness (1 − cos
///   cone)),
/// with s(t) = t held within [0, 1]; one unit is the light that shows a texture at its own value. It casts no shadow.
struct Lamp {
  base::Vec3 position = base::Vec3::Zero();    // m
  base::Vec3 direction = base::Vec3::UnitZ();  // of a spot; any length but 0
  double cone = 3.1415926535;                  // half angle where a spot's light ends, rad; π: shines all round
  double softness = 0.3;                       // share of the cone over which a spot's light fades to its rim
  double intensity = 10.0;                     // light at 1 m: a street lamp some 60, a torch 10
  base::Vec3 colour = base::Vec3::Ones();      // share by channel, linear
  double range = 20.0;                         // m, where its light has faded to nothing
};
void Describe(base::Description& d, Lamp& c);

/// Throw base::InputError for values that Describe would not let pass; `whose` begins the message.
void Check(const Fog& fog, std::string_view whose);
void Check(const Lamp& lamp, std::string_view whose);

}  // namespace alula::worlds
