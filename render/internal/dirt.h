#pragma once

#include <cstdint>
#include <vector>

#include "render/sensor_effects.h"

namespace alula::render::internal {

/// Of each pixel's light: what dirt lets through and what it scatters over the picture. Mud keeps the rest.
struct DirtMap {
  std::vector<float> through;
  std::vector<float> scattered;
};

/// Smudges are where a sum of soft discs at random places is highest; mud is a disc with a wavy rim somewhere. Both
/// cover the shares stated, because their limits are quantiles.
DirtMap MakeDirt(const Dirt& dirt, int width, int height, std::uint64_t key);

}  // namespace alula::render::internal
