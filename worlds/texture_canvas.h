#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"

namespace alula::worlds {

/// A square of tones (0 dark, 1 light) that wraps at its sides; `size` is a power of two.
struct Canvas {
  explicit Canvas(int side, float value = 0.5F)
      : size(side), tone(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), value) {}

  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y & (size - 1)) * static_cast<std::size_t>(size) +
           static_cast<std::size_t>(x & (size - 1));
  }
  float& At(int x, int y) { return tone[Index(x, y)]; }
  float At(int x, int y) const { return tone[Index(x, y)]; }

  int size;
  std::vector<float> tone;
};

/// Noise of equal variance in every octave from a quarter of the canvas down to one texel, mean 0, variance 1.
Canvas PinkNoise(int size, base::RandomStream& random);

/// "Dead leaves" (Matheron 1968; Lee, Mumford, Huang 2001): opaque random shapes with radii of density r⁻³ lie on one
/// another, which gives edges and corners at every scale, as natural pictures have them.
struct LeavesConfig {
  double coverage = 1.0;           // sum of the shapes' areas over the canvas's
  double radius_min = 2.5 / 1024;  // of the canvas's side
  double radius_max = 0.1;
  float tone_min = 0.0F;
  float tone_max = 1.0F;
  float opacity = 1.0F;
  double narrowest = 0.35;  // width over length, drawn between these: blades of grass and scratches have little
  double widest = 1.0;
};
void PaintLeaves(Canvas& canvas, const LeavesConfig& config, base::RandomStream& random);

/// Voronoi cells of a jittered grid of `columns` × `rows` points.
struct Cells {
  std::vector<std::uint32_t> id;  // per texel, of the nearest point
  std::vector<float> edge;        // per texel, distance to the nearest cell border in texels, about
};
Cells MakeCells(int size, int columns, int rows, double jitter, base::RandomStream& random);

}  // namespace alula::worlds
