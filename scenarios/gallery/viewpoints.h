#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/frames.h"
#include "stack/interface/calibration.h"
#include "worlds/world.h"

namespace alula::scenarios::gallery {

/// A pinhole camera with square pixels and 80° across its width.
stack::CameraIntrinsics WideCamera(int width, int height);

struct Viewpoint {
  std::string name;
  base::Transform X_WC;
};

/// From the start ahead and behind, at the target, and from a high corner of the bounds over the whole.
std::vector<Viewpoint> NamedViewpoints(const worlds::World& world);

/// `count` level views from free places (no object within 0.4 m) at 0.8–2.5 m above what lies below, anywhere in the
/// bounds, heading anywhere. Stream "gallery/views" of the seed. Throws base::InputError where no place is free.
std::vector<base::Transform> RandomViewpoints(const worlds::World& world, int count, std::uint64_t seed);

}  // namespace alula::scenarios::gallery
