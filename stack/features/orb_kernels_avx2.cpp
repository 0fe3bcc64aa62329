#include <immintrin.h>

#include "stack/features/internal/orb_kernels.h"

// No Eigen and no templates of the standard library here: this file is compiled for AVX2.
namespace alula::stack::features::internal {
namespace {

__m256i Load(const std::uint8_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
void Store(std::uint8_t* p, __m256i v) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }

/// Largest over the 16 arcs of 9 neighbours of the least of `d` on the arc.
__m256i BestArc(const __m256i* d) {
  __m256i two[16], four[16];
  for (int i = 0; i < 16; ++i) two[i] = _mm256_min_epu8(d[i], d[(i + 1) % 16]);
  for (int i = 0; i < 16; ++i) four[i] = _mm256_min_epu8(two[i], two[(i + 2) % 16]);
  __m256i best = _mm256_setzero_si256();
  for (int i = 0; i < 16; ++i) {
    const __m256i eight = _mm256_min_epu8(four[i], four[(i + 4) % 16]);
    best = _mm256_max_epu8(best, _mm256_min_epu8(eight, d[(i + 8) % 16]));
  }
  return best;
}

void CornerScores(const std::uint8_t* row, std::ptrdiff_t stride, int count, int threshold, std::uint8_t* scores) {
  std::ptrdiff_t circle[16];
  for (int i = 0; i < 16; ++i) circle[i] = kCircle[i][1] * stride + kCircle[i][0];
  const __m256i zero = _mm256_setzero_si256(), limit = _mm256_set1_epi8(static_cast<char>(threshold));
  __m256i brighter[16], darker[16];
  for (int x = 0; x < count; x += 32) {
    const __m256i centre = Load(row + x);
    const auto look = [&](int i) {
      const __m256i at = Load(row + x + circle[i]);
      brighter[i] = _mm256_subs_epu8(at, centre);
      darker[i] = _mm256_subs_epu8(centre, at);
    };
    // An arc of 9 holds one of each two opposite pixels: where every such pair is too weak, there is no corner.
    __m256i bound_b = _mm256_set1_epi8(-1), bound_d = bound_b;
    for (int i = 0; i < 8; i += 2) {
      look(i);
      look(i + 8);
      bound_b = _mm256_min_epu8(bound_b, _mm256_max_epu8(brighter[i], brighter[i + 8]));
      bound_d = _mm256_min_epu8(bound_d, _mm256_max_epu8(darker[i], darker[i + 8]));
    }
    const __m256i above = _mm256_subs_epu8(_mm256_max_epu8(bound_b, bound_d), limit);
    if (_mm256_testz_si256(above, above) != 0) {
      Store(scores + x, zero);
      continue;
    }
    for (int i = 1; i < 16; i += 2) look(i);
    const __m256i score = _mm256_max_epu8(BestArc(brighter), BestArc(darker));
    const __m256i weak = _mm256_cmpeq_epi8(_mm256_subs_epu8(score, limit), zero);
    Store(scores + x, _mm256_andnot_si256(weak, score));
  }
}

void Peaks(const std::uint8_t* scores, std::ptrdiff_t stride, int count, std::uint32_t* bits) {
  const __m256i zero = _mm256_setzero_si256();
  for (int x = 0; x < count; x += 32) {
    const std::uint8_t* s = scores + x;
    const __m256i own = Load(s);
    std::uint32_t word = 0;
    if (_mm256_testz_si256(own, own) == 0) {
      const std::uint8_t *above = s - stride, *below = s + stride;
      const __m256i before =
          _mm256_max_epu8(_mm256_max_epu8(Load(above - 1), Load(above)), _mm256_max_epu8(Load(above + 1), Load(s - 1)));
      const __m256i after =
          _mm256_max_epu8(_mm256_max_epu8(Load(below - 1), Load(below)), _mm256_max_epu8(Load(below + 1), Load(s + 1)));
      const __m256i not_above = _mm256_cmpeq_epi8(_mm256_subs_epu8(own, before), zero);
      const __m256i reaches = _mm256_cmpeq_epi8(_mm256_max_epu8(own, after), own);
      word = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_andnot_si256(not_above, reaches)));
    }
    if (count - x < 32) word &= (1U << (count - x)) - 1U;
    bits[x / 32] = word;
  }
}

/// 4 (a + g) + 8 (b + f) + 13 (c + e) + 14 d in 16 bits.
__m256i Weigh(__m256i ag, __m256i bf, __m256i ce, __m256i d) {
  const __m256i outer = _mm256_add_epi16(_mm256_slli_epi16(ag, 2), _mm256_slli_epi16(bf, 3));
  const __m256i inner =
      _mm256_add_epi16(_mm256_mullo_epi16(ce, _mm256_set1_epi16(13)), _mm256_mullo_epi16(d, _mm256_set1_epi16(14)));
  return _mm256_add_epi16(outer, inner);
}

void Smooth(const std::uint8_t* row, std::ptrdiff_t stride, int count, std::uint16_t* scratch, std::uint8_t* out) {
  const auto wide = [](const std::uint8_t* p) {
    return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  };
  for (int x = 0; x < count + 6; x += 16) {
    const std::uint8_t* p = row + x - 3;
    const __m256i ag = _mm256_add_epi16(wide(p - 3 * stride), wide(p + 3 * stride));
    const __m256i bf = _mm256_add_epi16(wide(p - 2 * stride), wide(p + 2 * stride));
    const __m256i ce = _mm256_add_epi16(wide(p - stride), wide(p + stride));
    const __m256i sum = _mm256_add_epi16(Weigh(ag, bf, ce, wide(p)), _mm256_set1_epi16(8));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(scratch + x), _mm256_srli_epi16(sum, 4));
  }
  for (int x = 0; x < count; x += 16) {
    const auto at = [&](int u) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(scratch + x + u)); };
    const __m256i sum = _mm256_add_epi16(
        Weigh(_mm256_add_epi16(at(0), at(6)), _mm256_add_epi16(at(1), at(5)), _mm256_add_epi16(at(2), at(4)), at(3)),
        _mm256_set1_epi16(128));
    const __m256i value = _mm256_srli_epi16(sum, 8);
    const __m128i bytes = _mm_packus_epi16(_mm256_castsi256_si128(value), _mm256_extracti128_si256(value, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + x), bytes);
  }
}

void BlendRows(const std::uint8_t* a, const std::uint8_t* b, int w, int count, std::uint8_t* out) {
  const __m256i weights = _mm256_set1_epi16(static_cast<short>((w << 8) | (64 - w)));
  const __m256i half = _mm256_set1_epi16(32);
  for (int x = 0; x < count; x += 32) {
    const __m256i va = Load(a + x), vb = Load(b + x);
    const __m256i low = _mm256_maddubs_epi16(_mm256_unpacklo_epi8(va, vb), weights);
    const __m256i high = _mm256_maddubs_epi16(_mm256_unpackhi_epi8(va, vb), weights);
    Store(out + x, _mm256_packus_epi16(_mm256_srli_epi16(_mm256_add_epi16(low, half), 6),
                                       _mm256_srli_epi16(_mm256_add_epi16(high, half), 6)));
  }
}

void BlendColumns(const std::uint8_t* row, const ColumnBlend* columns, int groups, std::uint8_t* out) {
  const __m128i half = _mm_set1_epi16(32);
  for (int g = 0; g < groups; ++g) {
    const ColumnBlend& c = columns[g];
    const __m128i source = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + c.first));
    const __m128i pairs = _mm_shuffle_epi8(source, _mm_loadu_si128(reinterpret_cast<const __m128i*>(c.pair)));
    const __m128i sums = _mm_maddubs_epi16(pairs, _mm_loadu_si128(reinterpret_cast<const __m128i*>(c.weight)));
    const __m128i values = _mm_srli_epi16(_mm_add_epi16(sums, half), 6);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(out + 8 * g), _mm_packus_epi16(values, values));
  }
}

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

OrbKernels Avx2OrbKernels() {
  return {CornerScores, Peaks, Smooth, BlendRows, BlendColumns, Moments, Describe, Distances};
}

}  // namespace alula::stack::features::internal
