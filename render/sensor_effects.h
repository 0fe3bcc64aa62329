#pragma once

#include <cstdint>

#include "base/describe.h"
#include "render/camera_renderer.h"

namespace alula::render {

/// Noise of an 8-bit image sensor, in grey levels: the variance of a pixel of mean value v is read_sigma² + shot·v
/// (EMVA 1288, section 2.3; a linear sensor without dark-signal non-uniformity).
struct PixelNoise {
  double read_sigma = 0.8;  // standard deviation in the dark, grey levels; a global-shutter CMOS at unit gain
  double shot = 0.012;      // variance per grey level: 255 levels on a full well of about 20,000 electrons
};
void Describe(base::Description& d, PixelNoise& c);

/// What differs from pixel to pixel and stays (EMVA 1288, section 4). An industrial CMOS sensor has about 0.5 and 0.01.
struct FixedPattern {
  double dark = 0.0;      // DSNU: 1σ of the offset, grey levels at gain 1
  double response = 0.0;  // PRNU: 1σ of the factor on the light
};
void Describe(base::Description& d, FixedPattern& c);

/// Dirt on the front lens, far out of focus. Smudges scatter the light they take over the whole picture; mud stops it.
struct Dirt {
  double smudged = 0.0;      // share of the picture behind smudges
  double smudge_loss = 0.4;  // share of the light that the thick of a smudge scatters
  double obscured = 0.0;     // share of the picture behind one patch of mud
  bool operator==(const Dirt&) const = default;
};
void Describe(base::Description& d, Dirt& c);
/// Both on one lens, each on its share of what the other leaves; the thicker smudges count. Where smudges and patch lie
/// is the camera's: they grow where they are.
Dirt Together(const Dirt& a, const Dirt& b);

/// Light that reflections and scatter inside the lens spread from the sun or a lamp over the picture: a veil that falls
/// with the square of the angle θ from the light (as Stiles and Holladay found for the eye), and ghosts, the light's
/// images after two reflections, on the line through it and the middle of the picture.
struct Glare {
  double veil = 0.0;  // grey levels that the unhidden sun adds 10° beside itself, at the nominal exposure; 20 is much
  double ghosts = 0.5;                // grey levels of the brightest ghost, share of `veil`
  double reach = 1.0471975511965976;  // angle of the light off the axis beyond which the hood keeps it out, rad (60°)
};
void Describe(base::Description& d, Glare& c);

/// All that a lens and its sensor do to the light of a pinhole picture, in the order in which it happens:
/// vignetting, dirt, glare, response of the pixel, saturation, shot and read noise, dark offset, gamma, quantisation.
/// ImageSensor (image_sensor.h) applies them. By default noise only.
struct SensorEffects {
  PixelNoise noise;
  FixedPattern fixed_pattern;
  double vignetting = 0.0;  // share of the light that is lost in the farthest corner, by the law of cos⁴
  Dirt dirt;
  Glare glare;
  double gamma = 1.0;  // a value v is shown as 255 (v / 255)^(1/gamma)
  int bits = 8;        // levels are 2^bits, spread over 0 … 255
};
void Describe(base::Description& d, SensorEffects& c);

/// Adds shot and read noise to every byte of the picture and rounds to [0, 255]. The noise is a pure function of
/// (key, place, value): give each image its own key (for instance hash of run seed, sensor name and sequence number).
/// Deviates are sums of four bytes of a 32-bit mix: normal to within ±3.4 σ. Equal on every machine.
void ApplyPixelNoise(Picture& picture, std::uint64_t key, const PixelNoise& noise);

}  // namespace alula::render
