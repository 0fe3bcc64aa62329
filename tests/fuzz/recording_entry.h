#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::fuzz {

/// Reads the bytes as each text file of KITTI's and TUM's layouts: calib.txt, times.txt, poses.txt, rgb.txt,
/// camera.yaml, and as a
/// trajectory that is written again. Bad input may only end in InputError.
void ReadRecordingFile(const std::uint8_t* data, std::size_t size);

}  // namespace alula::fuzz
