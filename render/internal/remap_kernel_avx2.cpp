#include <immintrin.h>

#include "render/internal/remap_kernel.h"

namespace alula::render::internal {

void RemapAvx2(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel, const std::uint8_t* right,
               const std::uint8_t* down, std::size_t count, std::uint8_t* out) {
  const auto* upper_row = reinterpret_cast<const int*>(canvas);
  const auto* lower_row = reinterpret_cast<const int*>(canvas + stride);
  const __m256i one = _mm256_set1_epi32(256);
  // Two bytes of each gathered word become the two halves of its 32 bits, for one multiply-add of pairs.
  const __m256i halves = _mm256_setr_epi8(0, -1, 1, -1, 4, -1, 5, -1, 8, -1, 9, -1, 12, -1, 13, -1,  //
                                          0, -1, 1, -1, 4, -1, 5, -1, 8, -1, 9, -1, 12, -1, 13, -1);
  const __m256i pack = _mm256_setr_epi8(0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1,  //
                                        0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256i place = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixel + i));
    const __m256i x = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(right + i)));
    const __m256i y = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(down + i)));
    const __m256i across = _mm256_or_si256(_mm256_sub_epi32(one, x), _mm256_slli_epi32(x, 16));
    const __m256i a = _mm256_shuffle_epi8(_mm256_i32gather_epi32(upper_row, place, 1), halves);
    const __m256i b = _mm256_shuffle_epi8(_mm256_i32gather_epi32(lower_row, place, 1), halves);
    const __m256i upper = _mm256_madd_epi16(a, across);
    const __m256i lower = _mm256_madd_epi16(b, across);
    __m256i sum = _mm256_add_epi32(_mm256_mullo_epi32(upper, _mm256_sub_epi32(one, y)), _mm256_mullo_epi32(lower, y));
    sum = _mm256_srli_epi32(_mm256_add_epi32(sum, _mm256_set1_epi32(32768)), 16);
    const __m256i bytes = _mm256_shuffle_epi8(sum, pack);
    const auto low = static_cast<std::uint32_t>(_mm256_extract_epi32(bytes, 0));
    const auto high = static_cast<std::uint32_t>(_mm256_extract_epi32(bytes, 4));
    const std::uint64_t both = low | static_cast<std::uint64_t>(high) << 32;
    __builtin_memcpy(out + i, &both, 8);
  }
  RemapBaseline(canvas, stride, pixel + i, right + i, down + i, count - i, out + i);
}

}  // namespace alula::render::internal
