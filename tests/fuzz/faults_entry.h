#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as a scenario's key `faults` and makes them for a vehicle with a sensor of each kind. Bad input may
/// only end in InputError; what is read must dump and read back to the same text, and what is made must get through a
/// few seconds without harm.
void ReadFaults(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
