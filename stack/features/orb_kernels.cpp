#include "stack/features/internal/orb_kernels.h"

#include <bit>
#include <cmath>

namespace alula::stack::features::internal {
namespace {

void Moments(const std::uint8_t* centre, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01) {
  *m10 = *m01 = 0;
  for (int v = -kPatchRadius; v <= kPatchRadius; ++v) {
    const std::uint8_t* row = centre + v * stride;
    std::int32_t sum = 0;
    for (int u = -RowHalf(v); u <= RowHalf(v); ++u) {
      *m10 += u * row[u];
      sum += row[u];
    }
    *m01 += v * sum;
  }
}

void Describe(const std::uint8_t* centre, std::ptrdiff_t stride, float c, float s, const BriefPattern& pattern,
              std::uint64_t* descriptor) {
  const auto at = [&](float x, float y) {
    const auto u = static_cast<std::ptrdiff_t>(std::lrint(c * x - s * y));
    const auto v = static_cast<std::ptrdiff_t>(std::lrint(s * x + c * y));
    return centre[v * stride + u];
  };
  for (std::size_t word = 0; word < 4; ++word) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 64; ++k) {
      const std::size_t i = 64 * word + k;
      const bool less = at(pattern.ax[i], pattern.ay[i]) < at(pattern.bx[i], pattern.by[i]);
      bits |= static_cast<std::uint64_t>(less) << k;
    }
    descriptor[word] = bits;
  }
}

void Distances(const std::uint64_t* query, const std::uint64_t* table, std::size_t count, std::uint16_t* out) {
  for (std::size_t i = 0; i < count; ++i, table += 4) {
    int distance = 0;
    for (std::size_t w = 0; w < 4; ++w) distance += std::popcount(query[w] ^ table[w]);
    out[i] = static_cast<std::uint16_t>(distance);
  }
}

OrbKernels Choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt")) return Avx2OrbKernels();
#endif
  return ScalarOrbKernels();
}

}  // namespace

OrbKernels ScalarOrbKernels() { return {Moments, Describe, Distances}; }

const OrbKernels& ChooseOrbKernels() {
  static const OrbKernels kernels = Choose();
  return kernels;
}

}  // namespace alula::stack::features::internal
