#pragma once

#include <cstddef>
#include <cstdint>

#include "stack/features/internal/brief_pattern.h"

namespace alula::stack::features::internal {

/// Inner loops of ORB. Integer sums, single-precision products without contraction and rounding to even: the same bits
/// from both sets.
struct OrbKernels {
  /// m10 = Σ u I(u, v), m01 = Σ v I(u, v) over the disc; bytes from −15 to +16 of each row are read.
  void (*moments)(const std::uint8_t* centre, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01);
  /// 256 tests with the pattern turned by the angle of cosine c and sine s. Bytes up to +18 are read.
  void (*describe)(const std::uint8_t* centre, std::ptrdiff_t stride, float c, float s, const BriefPattern& pattern,
                   std::uint64_t* descriptor);
  /// Hamming distances of one descriptor (4 words) to `count` that lie one after another.
  void (*distances)(const std::uint64_t* query, const std::uint64_t* table, std::size_t count, std::uint16_t* out);
};

OrbKernels ScalarOrbKernels();
OrbKernels Avx2OrbKernels();
/// The fastest that this processor runs.
const OrbKernels& ChooseOrbKernels();

}  // namespace alula::stack::features::internal
