#include "tests/fuzz/texture_entry.h"

#include <bit>
#include <string_view>

#include "base/error.h"
#include "geometry/internal/parse_texture.h"
#include "geometry/load_texture.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {

namespace {

/// CRC-32 as PNG wants it (ISO 3309), bit by bit.
std::uint32_t Crc(const std::uint8_t* data, std::size_t size) {
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

}  // namespace

void ReadTexture(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const geometry::Texture texture = geometry::internal::ParseTexture(bytes, "input.png");
    for (const int side : {texture.width, texture.height}) {
      Expect(side <= geometry::kMostTexels && std::has_single_bit(static_cast<unsigned>(side)), "side");
    }
    Expect(
        texture.rgb.size() == 3UL * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height),
        "number of bytes");
  } catch (const base::InputError& error) {
    ExpectOneLine(error.what());
  }
}

void MendChecksums(std::uint8_t* data, std::size_t size) {
  // After the signature: length, type, bytes, checksum; numbers big-endian.
  for (std::size_t at = 8; at + 12 <= size;) {
    const std::size_t length = (std::size_t{data[at]} << 24U) | (std::size_t{data[at + 1]} << 16U) |
                               (std::size_t{data[at + 2]} << 8U) | data[at + 3];
    if (length > size - at - 12) return;
    const std::uint32_t crc = Crc(data + at + 4, length + 4);
    for (unsigned i = 0; i < 4; ++i) data[at + 8 + length + i] = static_cast<std::uint8_t>(crc >> (24U - 8U * i));
    at += length + 12;
  }
}

}  // namespace alula::fuzz
