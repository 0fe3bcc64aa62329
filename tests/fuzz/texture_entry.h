#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a PNG texture. Bad input may only end in InputError of one printable line; a texture that is read
/// has sides that are powers of two and all of its bytes.
void ReadTexture(const std::uint8_t* data, std::size_t size);

/// Writes the right checksum behind each chunk of a PNG, so that a mutation gets past them.
void MendChecksums(std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
