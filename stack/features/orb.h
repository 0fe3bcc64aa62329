#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/frames.h"
#include "stack/features/descriptor.h"
#include "stack/features/orb_config.h"
#include "stack/interface/measurement.h"

namespace alula::stack::features {

/// A corner with a name: oriented FAST and rotated BRIEF (Rublee et al. 2011).
struct Keypoint {
  base::Vec2 pixel = base::Vec2::Zero();  // in the image itself, whatever the octave
  int octave = 0;                         // pyramid level that it was found on; 0 is the image
  double angle = 0.0;     // rad in (−π, π], from +u towards +v: intensity centroid seen from the corner
  double response = 0.0;  // what it was chosen by, grey levels
  Descriptor descriptor{};
};

/// Side of a pixel of an octave in pixels of the image: scale^octave; a keypoint's 1σ grows with it.
double OctaveScale(const OrbConfig& config, int octave);

/// Keypoints of an image, at most about `config.keypoints`, fine octaves first and in each from the top left on:
///   pyramid → FAST, where a cell has no corner with a lower threshold → one keypoint a leaf of a quadtree
///   → sub-pixel place → orientation → 256 tests on the smoothed octave.
/// Throws base::InputError where the image is not 8-bit grey.
std::vector<Keypoint> DetectOrb(const Image& image, const OrbConfig& config);

/// Describes given pixels (the corners of a tracker) at octave 0, one answer each: the pixel as it is given, with angle
/// and descriptor; none within 19 px of the edge.
std::vector<std::optional<Keypoint>> DescribeOrb(const Image& image, std::span<const base::Vec2> pixels);

}  // namespace alula::stack::features
