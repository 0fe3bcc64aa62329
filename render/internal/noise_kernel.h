#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::render::internal {

/// Adds noise of variance read_variance + shot·v to `count` bytes, keyed by the two words. The same loop is compiled
/// for the baseline and for AVX2; integer mixing and IEEE single operations without contraction give the same bytes.
using NoiseKernel = void (*)(std::uint8_t* pixels, std::size_t count, std::uint32_t key0, std::uint32_t key1,
                             float read_variance, float shot);
void AddNoiseBaseline(std::uint8_t* pixels, std::size_t count, std::uint32_t key0, std::uint32_t key1,
                      float read_variance, float shot);
void AddNoiseAvx2(std::uint8_t* pixels, std::size_t count, std::uint32_t key0, std::uint32_t key1, float read_variance,
                  float shot);

}  // namespace alula::render::internal
