#include "render/sensor_effects.h"

#include <algorithm>

#include "base/hash.h"
#include "render/internal/noise_kernel.h"

namespace alula::render {
namespace {

internal::NoiseKernel FastestKernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return internal::AddNoiseAvx2;
#endif
  return internal::AddNoiseBaseline;
}

}  // namespace

void Describe(base::Description& d, PixelNoise& c) {
  d.Field("read_sigma", c.read_sigma,
          {.unit = "1", .meaning = "standard deviation of a pixel in the dark, grey levels", .min = 0.0, .max = 64.0});
  d.Field("shot", c.shot, {.unit = "1", .meaning = "variance of shot noise per grey level", .min = 0.0, .max = 16.0});
}

void ApplyPixelNoise(Picture& picture, std::uint64_t key, const PixelNoise& noise) {
  if (noise.read_sigma <= 0.0 && noise.shot <= 0.0) return;
  base::RollingHash spread;  // so that neighbouring keys share nothing
  spread.Add(key);
  const std::uint64_t mixed = spread.value();
  constexpr double kRounding = 1.0 / 12.0;  // variance that rounding to grey levels adds
  static const internal::NoiseKernel kernel = FastestKernel();
  kernel(picture.bytes.data(), picture.bytes.size(), static_cast<std::uint32_t>(mixed),
         static_cast<std::uint32_t>(mixed >> 32), static_cast<float>(noise.read_sigma * noise.read_sigma - kRounding),
         static_cast<float>(noise.shot));
}

}  // namespace alula::render
