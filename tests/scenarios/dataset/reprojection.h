#pragma once

#include <array>
#include <vector>

#include "base/frames.h"
#include "scenarios/dataset/recording.h"

// Whether a dataset's images, stamps, extrinsics and ground truth belong together, seen from outside: corners of the
// left images are followed through both eyes and time, triangulated with nothing but what the files state, and
// projected back.
namespace alula::scenarios::dataset::testing {

/// Where one corner was seen.
struct Sighting {
  int eye = 0;  // 0 left, 1 right
  std::size_t frame = 0;
  base::Vec2 pixel;
};
using Track = std::vector<Sighting>;

/// Corners of every `stride`-th left image (Shi and Tomasi 1994), followed by optical flow (Lucas and Kanade) into the
/// next `length` left images and, at each, into the right one; kept where following back ends within half a pixel.
std::vector<Track> FollowCorners(const Recording& recording, std::size_t stride, std::size_t length);

struct ReprojectionFigures {
  std::array<double, 2> median{};  // of |measured − projected| in each eye, px
  std::array<std::size_t, 2> sightings{};
  std::size_t landmarks = 0;
};

/// Triangulates each track by least squares of its reprojection errors, all cameras standing where ground truth, stamps
/// and sensor.yaml say, and gives what is left.
ReprojectionFigures Reproject(const Recording& recording, const std::vector<Track>& tracks);

}  // namespace alula::scenarios::dataset::testing
