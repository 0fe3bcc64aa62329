#include "render/sensor_effects.h"

#include <algorithm>

#include "base/hash.h"
#include "render/internal/sensor_kernel.h"

namespace alula::render {

void Describe(base::Description& d, PixelNoise& c) {
  d.Field("read_sigma", c.read_sigma,
          {.unit = "1", .meaning = "standard deviation of a pixel in the dark, grey levels", .min = 0.0, .max = 64.0});
  d.Field("shot", c.shot, {.unit = "1", .meaning = "variance of shot noise per grey level", .min = 0.0, .max = 16.0});
}

void Describe(base::Description& d, FixedPattern& c) {
  d.Field("dark", c.dark,
          {.unit = "1", .meaning = "DSNU: spread of the pixels' offsets, grey levels at gain 1", .min = 0, .max = 30});
  d.Field("response", c.response,
          {.unit = "1", .meaning = "PRNU: spread of the pixels' response, share", .min = 0, .max = 0.25});
}

void Describe(base::Description& d, Dirt& c) {
  d.Field("smudged", c.smudged, {.unit = "1", .meaning = "share of the picture behind smudges", .min = 0, .max = 0.9});
  d.Field("smudge_loss", c.smudge_loss,
          {.unit = "1", .meaning = "share of the light that the thick of a smudge scatters", .min = 0, .max = 1});
  d.Field("obscured", c.obscured,
          {.unit = "1", .meaning = "share of the picture behind a patch of mud", .min = 0, .max = 1});
}

Dirt Together(const Dirt& a, const Dirt& b) {
  const auto either = [](double x, double y) { return 1.0 - (1.0 - x) * (1.0 - y); };
  return {either(a.smudged, b.smudged), std::max(a.smudge_loss, b.smudge_loss), either(a.obscured, b.obscured)};
}

void Describe(base::Description& d, Glare& c) {
  d.Field("veil", c.veil,
          {.unit = "1", .meaning = "grey levels that the sun adds 10 deg beside itself", .min = 0, .max = 255});
  d.Field("ghosts", c.ghosts, {.unit = "1", .meaning = "brightest ghost, share of the veil", .min = 0, .max = 10});
  d.Field("reach", c.reach,
          {.unit = "rad", .meaning = "angle off the axis beyond which the hood shades the lens", .min = 0, .max = 3.2});
}

void Describe(base::Description& d, SensorEffects& c) {
  d.Field("noise", c.noise, {.meaning = "of the pixels"});
  d.Field("fixed_pattern", c.fixed_pattern, {.meaning = "differences between pixels that stay"});
  d.Field("vignetting", c.vignetting,
          {.unit = "1", .meaning = "share of the light lost in the farthest corner", .min = 0, .max = 0.95});
  d.Field("dirt", c.dirt, {.meaning = "on the lens"});
  d.Field("glare", c.glare, {.meaning = "of sun and lamps"});
  d.Field("gamma", c.gamma, {.unit = "1", .meaning = "value v is shown as v^(1/gamma)", .min = 0.2, .max = 5});
  d.Field("bits", c.bits, {.unit = "1", .meaning = "a pixel; levels are spread over 0 to 255", .min = 1, .max = 8});
}

void ApplyPixelNoise(Picture& picture, std::uint64_t key, const PixelNoise& noise) {
  if (noise.read_sigma <= 0.0 && noise.shot <= 0.0) return;
  base::RollingHash spread;  // so that neighbouring keys share nothing
  spread.Add(key);
  const std::uint64_t mixed = spread.value();
  constexpr double kRounding = 1.0 / 12.0;  // variance that rounding to grey levels adds
  static const internal::SensorKernel kernel = internal::ChooseSensorKernel();
  kernel({.pixels = picture.bytes.data(),
          .count = picture.bytes.size(),
          .first = 0,
          .key0 = static_cast<std::uint32_t>(mixed),
          .key1 = static_cast<std::uint32_t>(mixed >> 32),
          .read_variance = static_cast<float>(noise.read_sigma * noise.read_sigma - kRounding),
          .shot = static_cast<float>(noise.shot),
          .transmission = nullptr,
          .added = nullptr,
          .response = nullptr,
          .dark = nullptr,
          .dark_step = 0.0F,
          .tone = nullptr});
}

}  // namespace alula::render
