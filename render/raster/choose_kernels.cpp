#include "render/raster/kernels_avx2.h"

namespace alula::render::raster {

const Kernels* Avx2KernelsOrNull() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Avx2Table();
#endif
  return nullptr;
}

}  // namespace alula::render::raster
