#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a vocabulary. Bad input may only end in InputError of one printable line; one that is read finds
/// a word for any descriptor and goes back to the same bytes.
void ReadVocabulary(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
