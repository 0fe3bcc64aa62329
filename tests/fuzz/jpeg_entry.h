#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a JPEG image and makes it grey. Bad input may only end in InputError.
void ReadJpeg(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
