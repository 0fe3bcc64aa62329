#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace alula::stack::features {

/// 256 binary tests of a patch or a line; bit i of the string is bit i % 64 of word i / 64.
using Descriptor = std::array<std::uint64_t, 4>;

/// Number of bits that differ.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) distance += std::popcount(a[i] ^ b[i]);
  return distance;
}

/// The Hamming distance of `query` to every descriptor of `table`; `distances` has the table's size. The way for many:
/// about 2 ns each.
void HammingDistances(const Descriptor& query, std::span<const Descriptor> table, std::span<std::uint16_t> distances);

/// Element `a` of the first set is the same thing as element `b` of the second.
struct DescriptorMatch {
  int a = 0;
  int b = 0;
  int distance = 0;
};

/// What a match must satisfy.
struct MatchConfig {
  int max_distance = 64;  // bits; two views of one corner differ by 10–50, unrelated corners by about 128
  double ratio = 0.8;     // the best must be below this share of the next best (Lowe 2004); 1: no such test
  bool mutual = true;     // b's best is a as well
};

/// Nearest neighbours of all `a` in `b` by exhaustive comparison, ascending in `a`; of equal distances the first wins.
std::vector<DescriptorMatch> MatchDescriptors(std::span<const Descriptor> a, std::span<const Descriptor> b,
                                              const MatchConfig& config);

}  // namespace alula::stack::features
