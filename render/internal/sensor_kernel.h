#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::render::internal {

/// Bytes of a picture to pass through ImageSensor's equation. Arrays begin at the first byte; a null one has no effect.
struct SensorJob {
  std::uint8_t* pixels;
  std::size_t count;
  std::uint32_t first;  // number of the first byte in the picture: with the keys it makes the noise
  std::uint32_t key0, key1;
  float read_variance;  // grey levels²; less than 0: what rounding adds by itself has been taken off
  float shot;
  const std::uint16_t* transmission;  // 1/32768
  const float* added;                 // grey levels
  const std::int16_t* response;       // 1/32768; either both or none of response and dark
  const std::int16_t* dark;           // dark_step each
  float dark_step;
  const std::uint8_t* tone;  // kToneSteps a level, from 0 to 255
};
inline constexpr int kToneSteps = 16;

/// The same loop is compiled for the baseline and for AVX2; integer mixing and IEEE single operations without
/// contraction give the same bytes.
using SensorKernel = void (*)(const SensorJob& job);
void SenseBaseline(const SensorJob& job);
void SenseAvx2(const SensorJob& job);
/// The fastest that this processor runs.
SensorKernel ChooseSensorKernel();

}  // namespace alula::render::internal
