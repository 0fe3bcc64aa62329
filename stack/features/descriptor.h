#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace alula::stack::features {

/// A binary descriptor of 256 bits.
using Descriptor = std::array<std::uint64_t, 4>;

/// How many bits differ.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += std::popcount(a[i] ^ b[i]);
  return bits;
}

}  // namespace alula::stack::features
