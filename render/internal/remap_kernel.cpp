#include "render/internal/remap_kernel.h"

namespace alula::render::internal {

void RemapBaseline(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel,
                   const std::uint8_t* right, const std::uint8_t* down, std::size_t count, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = canvas + pixel[i];
    const std::uint32_t x = right[i], y = down[i];
    const std::uint32_t upper = p[0] * (256 - x) + p[1] * x;
    const std::uint32_t lower = p[stride] * (256 - x) + p[stride + 1] * x;
    out[i] = static_cast<std::uint8_t>((upper * (256 - y) + lower * y + 32768) >> 16);
  }
}

void RemapColourBaseline(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel,
                         const std::uint8_t* right, const std::uint8_t* down, std::size_t count, std::uint8_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = canvas + 3 * static_cast<std::size_t>(pixel[i]);
    const std::uint8_t* q = p + 3 * stride;
    const std::uint32_t x = right[i], y = down[i];
    for (int c = 0; c < 3; ++c, ++p, ++q) {
      const std::uint32_t upper = p[0] * (256 - x) + p[3] * x;
      const std::uint32_t lower = q[0] * (256 - x) + q[3] * x;
      *out++ = static_cast<std::uint8_t>((upper * (256 - y) + lower * y + 32768) >> 16);
    }
  }
}

RemapKernel ChooseRemap(int channels) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return channels == 1 ? RemapAvx2 : RemapColourAvx2;
#endif
  return channels == 1 ? RemapBaseline : RemapColourBaseline;
}

}  // namespace alula::render::internal
