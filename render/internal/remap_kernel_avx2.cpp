#include <immintrin.h>

#include "render/internal/remap_kernel.h"

namespace alula::render::internal {

// Weighted sums of two bytes with weights of 1/256 fill 16 bits without sign. For the second sum, by multiply-add of
// pairs, which takes signed factors, they are lowered by 2¹⁵; `kBack` gives that back and rounds.
namespace {
constexpr int kBack = 32768 * 256 + 32768;
}

void RemapAvx2(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel, const std::uint8_t* right,
               const std::uint8_t* down, std::size_t count, std::uint8_t* out) {
  // Two 16-bit loads a pixel into a buffer cost less than gathers of 32 bits.
  constexpr std::size_t kBlock = 256;
  alignas(32) std::uint32_t squares[kBlock];  // upper left, upper right, lower left, lower right
  const __m256i one = _mm256_set1_epi16(256);
  const __m256i bytes = _mm256_set1_epi32(0x00ff00ff);
  const __m256i lowered = _mm256_set1_epi16(INT16_MIN);
  const __m256i pack = _mm256_setr_epi8(0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1,  //
                                        0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  std::size_t i = 0;
  while (i + 8 <= count) {
    const std::size_t n = count - i < kBlock ? (count - i) / 8 * 8 : kBlock;
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint8_t* p = canvas + pixel[i + k];
      std::uint16_t upper, lower;
      __builtin_memcpy(&upper, p, 2);
      __builtin_memcpy(&lower, p + stride, 2);
      squares[k] = upper | static_cast<std::uint32_t>(lower) << 16;
    }
    for (std::size_t k = 0; k < n; k += 8) {
      const __m256i square = _mm256_load_si256(reinterpret_cast<const __m256i*>(squares + k));
      __m256i x = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(right + i + k)));
      __m256i y = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(down + i + k)));
      x = _mm256_or_si256(x, _mm256_slli_epi32(x, 16));
      y = _mm256_or_si256(_mm256_sub_epi32(_mm256_srli_epi32(one, 16), y), _mm256_slli_epi32(y, 16));
      const __m256i lefts = _mm256_mullo_epi16(_mm256_and_si256(square, bytes), _mm256_sub_epi16(one, x));
      const __m256i rights = _mm256_mullo_epi16(_mm256_and_si256(_mm256_srli_epi32(square, 8), bytes), x);
      const __m256i rows = _mm256_add_epi16(_mm256_add_epi16(lefts, rights), lowered);
      const __m256i sum = _mm256_add_epi32(_mm256_madd_epi16(rows, y), _mm256_set1_epi32(kBack));
      const __m256i packed = _mm256_shuffle_epi8(_mm256_srli_epi32(sum, 16), pack);
      const auto low = static_cast<std::uint32_t>(_mm256_extract_epi32(packed, 0));
      const auto high = static_cast<std::uint32_t>(_mm256_extract_epi32(packed, 4));
      const std::uint64_t both = low | static_cast<std::uint64_t>(high) << 32;
      __builtin_memcpy(out + i + k, &both, 8);
    }
    i += n;
  }
  RemapBaseline(canvas, stride, pixel + i, right + i, down + i, count - i, out + i);
}

void RemapColourAvx2(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel,
                     const std::uint8_t* right, const std::uint8_t* down, std::size_t count, std::uint8_t* out) {
  const std::ptrdiff_t row = 3 * stride;
  // Of the 16-bit sums r g b r' g' b' of two columns: pairs (r, r') (g, g') (b, b').
  const __m128i pairs = _mm_setr_epi8(0, 1, 6, 7, 2, 3, 8, 9, 4, 5, 10, 11, -1, -1, -1, -1);
  const __m128i pack = _mm_setr_epi8(0, 4, 8, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  const __m128i one = _mm_set1_epi16(256);
  const auto load = [](const std::uint8_t* p) {
    return _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  };
  std::size_t i = 0;
  for (; i + 2 <= count; ++i) {  // four bytes are written a pixel: one more pixel must follow
    const std::uint8_t* p = canvas + 3 * static_cast<std::size_t>(pixel[i]);
    const std::uint32_t x = right[i];
    const __m128i y = _mm_set1_epi16(static_cast<std::int16_t>(down[i]));
    const __m128i across = _mm_set1_epi32(static_cast<int>(256 + x * 65535));  // 256 − x, x
    const __m128i upper = _mm_mullo_epi16(load(p), _mm_sub_epi16(one, y));
    const __m128i lower = _mm_mullo_epi16(load(p + row), y);
    const __m128i columns = _mm_add_epi16(_mm_add_epi16(upper, lower), _mm_set1_epi16(INT16_MIN));
    const __m128i sums = _mm_madd_epi16(_mm_shuffle_epi8(columns, pairs), across);
    const __m128i levels = _mm_srli_epi32(_mm_add_epi32(sums, _mm_set1_epi32(kBack)), 16);
    const int pixel_bytes = _mm_cvtsi128_si32(_mm_shuffle_epi8(levels, pack));
    __builtin_memcpy(out + 3 * i, &pixel_bytes, 4);
  }
  RemapColourBaseline(canvas, stride, pixel + i, right + i, down + i, count - i, out + 3 * i);
}

}  // namespace alula::render::internal
