#include "render/internal/noise_kernel.h"

namespace alula::render::internal {

void AddNoiseAvx2(std::uint8_t* pixels, std::size_t count, std::uint32_t key0, std::uint32_t key1, float read_variance,
                  float shot)
#include "render/internal/noise_loop.inc"

}  // namespace alula::render::internal
