#include <immintrin.h>

#include "stack/features/internal/orb_kernels.h"

// No Eigen and no templates of the standard library here: this file is compiled for AVX2.
namespace alula::stack::features::internal {
namespace {

/// Row v's weights u inside the disc, 0 outside, and its mask; lane 0 is u = −15.
struct DiscRows {
  alignas(32) std::int8_t weight[2 * kPatchRadius + 1][32];
  alignas(32) std::uint8_t mask[2 * kPatchRadius + 1][32];
};

constexpr DiscRows MakeRows() {
  DiscRows rows{};
  for (int v = -kPatchRadius; v <= kPatchRadius; ++v) {
    for (int u = -kPatchRadius; u <= kPatchRadius; ++u) {
      const bool inside = u * u <= RowHalf(v) * RowHalf(v);
      rows.weight[v + kPatchRadius][u + kPatchRadius] = static_cast<std::int8_t>(inside ? u : 0);
      rows.mask[v + kPatchRadius][u + kPatchRadius] = inside ? 0xFF : 0;
    }
  }
  return rows;
}
constexpr DiscRows kRows = MakeRows();

std::int32_t Sum(__m256i v) {
  __m128i s = _mm_add_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  s = _mm_add_epi32(s, _mm_shuffle_epi32(s, _MM_SHUFFLE(1, 0, 3, 2)));
  s = _mm_add_epi32(s, _mm_shuffle_epi32(s, _MM_SHUFFLE(2, 3, 0, 1)));
  return _mm_cvtsi128_si32(s);
}

void Moments(const std::uint8_t* centre, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01) {
  const __m256i ones = _mm256_set1_epi16(1), zero = _mm256_setzero_si256();
  __m256i along_u = zero, along_v = zero;
  const std::uint8_t* row = centre - kPatchRadius * stride - kPatchRadius;
  for (int v = -kPatchRadius; v <= kPatchRadius; ++v, row += stride) {
    const __m256i pixels = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row));
    const __m256i weight = _mm256_load_si256(reinterpret_cast<const __m256i*>(kRows.weight[v + kPatchRadius]));
    const __m256i mask = _mm256_load_si256(reinterpret_cast<const __m256i*>(kRows.mask[v + kPatchRadius]));
    along_u = _mm256_add_epi32(along_u, _mm256_madd_epi16(_mm256_maddubs_epi16(pixels, weight), ones));
    const __m256i sums = _mm256_sad_epu8(_mm256_and_si256(pixels, mask), zero);  // four, in even 32-bit lanes
    along_v = _mm256_add_epi32(along_v, _mm256_mullo_epi32(sums, _mm256_set1_epi32(v)));
  }
  *m10 = Sum(along_u);
  *m01 = Sum(along_v);
}

/// Bytes at the turned places of eight points, as 32-bit lanes.
__m256i Sample(const std::uint8_t* centre, __m256i stride, __m256 c, __m256 s, const float* x, const float* y) {
  const __m256 px = _mm256_loadu_ps(x), py = _mm256_loadu_ps(y);
  const __m256i u = _mm256_cvtps_epi32(_mm256_sub_ps(_mm256_mul_ps(c, px), _mm256_mul_ps(s, py)));
  const __m256i v = _mm256_cvtps_epi32(_mm256_add_ps(_mm256_mul_ps(s, px), _mm256_mul_ps(c, py)));
  const __m256i offset = _mm256_add_epi32(_mm256_mullo_epi32(v, stride), u);
  const __m256i words = _mm256_i32gather_epi32(reinterpret_cast<const int*>(centre), offset, 1);
  return _mm256_and_si256(words, _mm256_set1_epi32(0xFF));
}

void Describe(const std::uint8_t* centre, std::ptrdiff_t stride, float c, float s, const BriefPattern& pattern,
              std::uint64_t* descriptor) {
  const __m256 cosine = _mm256_set1_ps(c), sine = _mm256_set1_ps(s);
  const __m256i step = _mm256_set1_epi32(static_cast<int>(stride));
  for (int word = 0; word < 4; ++word) {
    std::uint64_t bits = 0;
    for (int k = 0; k < 64; k += 8) {
      const int i = 64 * word + k;
      const __m256i a = Sample(centre, step, cosine, sine, pattern.ax + i, pattern.ay + i);
      const __m256i b = Sample(centre, step, cosine, sine, pattern.bx + i, pattern.by + i);
      const int less = _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b, a)));
      bits |= static_cast<std::uint64_t>(less) << k;
    }
    descriptor[word] = bits;
  }
}

void Distances(const std::uint64_t* query, const std::uint64_t* table, std::size_t count, std::uint16_t* out) {
  const std::uint64_t q0 = query[0], q1 = query[1], q2 = query[2], q3 = query[3];
  for (std::size_t i = 0; i < count; ++i, table += 4) {
    out[i] = static_cast<std::uint16_t>(_mm_popcnt_u64(q0 ^ table[0]) + _mm_popcnt_u64(q1 ^ table[1]) +
                                        _mm_popcnt_u64(q2 ^ table[2]) + _mm_popcnt_u64(q3 ^ table[3]));
  }
}

}  // namespace

OrbKernels Avx2OrbKernels() { return {Moments, Describe, Distances}; }

}  // namespace alula::stack::features::internal
