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

RemapKernel ChooseRemap() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return RemapAvx2;
#endif
  return RemapBaseline;
}

}  // namespace alula::render::internal
