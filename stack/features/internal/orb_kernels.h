#pragma once

#include <cstddef>
#include <cstdint>

#include "stack/features/internal/brief_pattern.h"

namespace alula::stack::features::internal {

/// Eight neighbouring columns of a smaller image: output k is the blend of source columns first + pair[2k] and
/// first + pair[2k + 1] with weights of 64 in all.
struct ColumnBlend {
  std::int32_t first;
  std::uint8_t pair[16];
  std::int8_t weight[16];
};

/// Inner loops of ORB on raw pixels. Integer arithmetic, and single-precision products without contraction and rounded
/// to even: the same bits from both sets. Rows may be read 64 bytes beyond their last pixel, and rows that are written
/// have as much room: `internal/octave.h` sees to it.
struct OrbKernels {
  /// Scores of `count` pixels of a row: with the circle of 16 pixels of radius 3, the largest t for which 9 neighbours
  /// on it are all brighter by t, or all darker by t (Rosten and Drummond 2006); 0 where that is not above `threshold`.
  void (*corner_scores)(const std::uint8_t* row, std::ptrdiff_t stride, int count, int threshold, std::uint8_t* scores);
  /// A bit for each of `count` scores (32 a word) that is not 0 and the largest of its 3×3 neighbours; of equal ones
  /// the first in reading order.
  void (*peaks)(const std::uint8_t* scores, std::ptrdiff_t stride, int count, std::uint32_t* bits);
  /// `count` pixels of a row, smoothed by (4, 8, 13, 14, 13, 8, 4)/64 along and down, a Gaussian of σ = 2 px. Three
  /// pixels around are read. `scratch`: count + 64 numbers.
  void (*smooth)(const std::uint8_t* row, std::ptrdiff_t stride, int count, std::uint16_t* scratch, std::uint8_t* out);
  /// out = ((64 − w) a + w b + 32) / 64 for `count` pixels.
  void (*blend_rows)(const std::uint8_t* a, const std::uint8_t* b, int w, int count, std::uint8_t* out);
  /// Eight pixels for each of `groups`.
  void (*blend_columns)(const std::uint8_t* row, const ColumnBlend* columns, int groups, std::uint8_t* out);
  /// m10 = Σ u I(u, v), m01 = Σ v I(u, v) over the disc around `centre`.
  void (*moments)(const std::uint8_t* centre, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01);
  /// 256 tests with the pattern turned by the angle of cosine c and sine s.
  void (*describe)(const std::uint8_t* centre, std::ptrdiff_t stride, float c, float s, const BriefPattern& pattern,
                   std::uint64_t* descriptor);
  /// Hamming distances of one descriptor (4 words) to `count` that lie one after another.
  void (*distances)(const std::uint64_t* query, const std::uint64_t* table, std::size_t count, std::uint16_t* out);
};

/// Offsets (u, v) of FAST's circle, one after another.
inline constexpr int kCircle[16][2] = {{0, -3}, {1, -3}, {2, -2}, {3, -1}, {3, 0},  {3, 1},   {2, 2},   {1, 3},
                                       {0, 3},  {-1, 3}, {-2, 2}, {-3, 1}, {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

OrbKernels ScalarOrbKernels();
OrbKernels Avx2OrbKernels();
/// The fastest that this processor runs.
const OrbKernels& ChooseOrbKernels();

}  // namespace alula::stack::features::internal
