#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "geometry/material.h"
#include "worlds/textures.h"

namespace alula::worlds {

/// Pictures of foliage with holes (alpha) between the leaves, inside the unit square: v grows upwards.
enum class Foliage {
  kSpray,    // a bunch of some hundred leaves about the middle: crowns and shrubs
  kNeedles,  // a conifer's branch, from the left to its tip at the right
  kTuft,     // blades and stalks that rise from the lower side: grass, weeds
  kFlowers,  // stems with leaves that rise from the lower side, blossoms on top
  kTree,     // a whole broad-leaved tree on its trunk, for far away
  kFir       // a whole conifer
};

/// `leaves`: what their tone runs between. `blossom`: of kFlowers. From the stream "world/foliage/<name>" of `seed`.
struct FoliageConfig {
  Foliage kind = Foliage::kSpray;
  Palette leaves{{0.09F, 0.14F, 0.04F}, {0.45F, 0.55F, 0.22F}};
  Palette wood{{0.14F, 0.11F, 0.08F}, {0.42F, 0.36F, 0.30F}};
  Palette blossom{{0.65F, 0.10F, 0.15F}, {0.95F, 0.55F, 0.45F}};
  int size = 256;  // texels a side, a power of two
};
std::shared_ptr<const geometry::Texture> MakeFoliageTexture(const FoliageConfig& config, std::uint64_t seed,
                                                            std::string_view name);

}  // namespace alula::worlds
