#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as each of the files of a dataset: sensor.yaml of a camera and of an IMU, a PNG image, and a table
/// of poses (TUM or EuRoC). Bad input may only end in InputError.
void ReadDatasetFile(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
