#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::render::raster {

/// Place of (x, y), each below 2¹⁶, in Morton order: the bits of x in the even places, of y in the odd ones.
constexpr std::size_t Morton(int x, int y) {
  std::size_t place = 0;
  for (int bit = 0; bit < 16; ++bit) {
    place |= static_cast<std::size_t>((x >> bit) & 1) << (2 * bit);
    place |= static_cast<std::size_t>((y >> bit) & 1) << (2 * bit + 1);
  }
  return place;
}

}  // namespace alula::render::raster
