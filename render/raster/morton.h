#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::render::raster {

/// The sixteen bits of x, moved to the even places.
constexpr std::size_t SpreadBits(int x) {
  auto bits = static_cast<std::uint32_t>(x) & 0xffffU;
  bits = (bits | bits << 8) & 0x00ff00ffU;
  bits = (bits | bits << 4) & 0x0f0f0f0fU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

/// Place of (x, y), each below 2¹⁶, in Morton order: the bits of x in the even places, of y in the odd ones.
constexpr std::size_t Morton(int x, int y) { return SpreadBits(x) | SpreadBits(y) << 1; }

}  // namespace alula::render::raster
