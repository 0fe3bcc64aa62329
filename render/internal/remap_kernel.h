#pragma once

#include <cstddef>
#include <cstdint>

namespace alula::render::internal {

/// out[i] = the four pixels about place i of the table, weighted by 1/256 steps, rounded: for one byte a pixel. Reads
/// up to three bytes beyond the last pixel named. Whole numbers throughout: every build gives the same bytes.
using RemapKernel = void (*)(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel,
                             const std::uint8_t* right, const std::uint8_t* down, std::size_t count, std::uint8_t* out);
void RemapBaseline(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel,
                   const std::uint8_t* right, const std::uint8_t* down, std::size_t count, std::uint8_t* out);
void RemapAvx2(const std::uint8_t* canvas, std::ptrdiff_t stride, const std::uint32_t* pixel, const std::uint8_t* right,
               const std::uint8_t* down, std::size_t count, std::uint8_t* out);
/// The fastest that this processor runs.
RemapKernel ChooseRemap();

}  // namespace alula::render::internal
