#include "stack/features/internal/orb_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace alula::stack::features::internal {
namespace {

void CornerScores(const std::uint8_t* row, std::ptrdiff_t stride, int count, int threshold, std::uint8_t* scores) {
  for (int x = 0; x < count; ++x) {
    int difference[16 + 8];
    for (int i = 0; i < 24; ++i) difference[i] = row[x + kCircle[i % 16][1] * stride + kCircle[i % 16][0]] - row[x];
    int score = 0;
    for (int i = 0; i < 16; ++i) {
      int brighter = 255, darker = 255;
      for (int k = i; k < i + 9; ++k) {
        brighter = std::min(brighter, difference[k]);
        darker = std::min(darker, -difference[k]);
      }
      score = std::max({score, brighter, darker});
    }
    scores[x] = static_cast<std::uint8_t>(score > threshold ? score : 0);
  }
}

void Peaks(const std::uint8_t* scores, std::ptrdiff_t stride, int count, std::uint32_t* bits) {
  for (int x = 0; x < count; x += 32) {
    std::uint32_t word = 0;
    for (int k = 0; k < std::min(32, count - x); ++k) {
      const std::uint8_t* s = scores + x + k;
      const std::uint8_t *above = s - stride, *below = s + stride;
      const int before = std::max({above[-1], above[0], above[1], s[-1]});
      const int after = std::max({s[1], below[-1], below[0], below[1]});
      const bool peak = *s > before && *s >= after;
      word |= static_cast<std::uint32_t>(peak) << k;
    }
    bits[x / 32] = word;
  }
}

void Smooth(const std::uint8_t* row, std::ptrdiff_t stride, int count, std::uint16_t* scratch, std::uint8_t* out) {
  constexpr int kWeight[7] = {4, 8, 13, 14, 13, 8, 4};
  for (int x = -3; x < count + 3; ++x) {
    int sum = 0;
    for (int v = -3; v <= 3; ++v) sum += kWeight[v + 3] * row[x + v * stride];
    scratch[x + 3] = static_cast<std::uint16_t>((sum + 8) / 16);  // two bits are kept
  }
  for (int x = 0; x < count; ++x) {
    int sum = 0;
    for (int u = 0; u < 7; ++u) sum += kWeight[u] * scratch[x + u];
    out[x] = static_cast<std::uint8_t>((sum + 128) / 256);
  }
}

void BlendRows(const std::uint8_t* a, const std::uint8_t* b, int w, int count, std::uint8_t* out) {
  for (int x = 0; x < count; ++x) out[x] = static_cast<std::uint8_t>(((64 - w) * a[x] + w * b[x] + 32) / 64);
}

void BlendColumns(const std::uint8_t* row, const ColumnBlend* columns, int groups, std::uint8_t* out) {
  for (int g = 0; g < groups; ++g) {
    const ColumnBlend& c = columns[g];
    for (int k = 0; k < 8; ++k) {
      const int sum =
          c.weight[2 * k] * row[c.first + c.pair[2 * k]] + c.weight[2 * k + 1] * row[c.first + c.pair[2 * k + 1]];
      out[8 * g + k] = static_cast<std::uint8_t>((sum + 32) / 64);
    }
  }
}

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

OrbKernels ScalarOrbKernels() {
  return {CornerScores, Peaks, Smooth, BlendRows, BlendColumns, Moments, Describe, Distances};
}

const OrbKernels& ChooseOrbKernels() {
  static const OrbKernels kernels = Choose();
  return kernels;
}

}  // namespace alula::stack::features::internal
