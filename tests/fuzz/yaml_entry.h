#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a YAML file of the sample vehicle, with and without an override. Bad input may only end in
/// InputError; what is read must dump and read back to the same text.
void ReadYaml(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
