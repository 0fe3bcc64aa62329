#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "stack/features/orb_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features::internal {

/// 8-bit pixels with room for kernels that read and write whole vectors: 64 bytes follow every row and the last one.
struct Octave {
  int width = 0;
  int height = 0;
  int stride = 0;
  std::unique_ptr<std::uint8_t[]> bytes;

  /// Pixels without values yet.
  Octave(int w, int h)
      : width(w),
        height(h),
        stride(w + 64),
        bytes(std::make_unique_for_overwrite<std::uint8_t[]>(static_cast<std::size_t>(stride) * (h + 1))) {}
  const std::uint8_t* Row(int v) const { return bytes.get() + static_cast<std::ptrdiff_t>(v) * stride; }
  std::uint8_t* Row(int v) { return bytes.get() + static_cast<std::ptrdiff_t>(v) * stride; }
};

/// px kept free at the edge of each level: the disc, the smoothing around it, and one.
inline constexpr int kOrbBorder = 19;

/// A copy of the image. Throws base::InputError where it is not 8-bit grey.
Octave FirstOctave(const Image& image);

/// The image and its coarser octaves, each made from the one before by bilinear blending, as far as a patch fits in.
std::vector<Octave> BuildOctaves(const Image& image, const OrbConfig& config);

/// Smoothed by a Gaussian of σ = 2 px, all but three pixels at the edge: BRIEF compares single pixels, which must stand
/// for their surroundings (Calonder et al. 2010). `smooth` is no smaller than the octave and is used from its corner.
void Smooth(const Octave& octave, Octave& smooth);

}  // namespace alula::stack::features::internal
