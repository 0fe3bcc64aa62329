#pragma once

#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/kit/indoor_light.h"
#include "worlds/world.h"

namespace alula::worlds {

/// The office that paper P1 maps: a corridor of 6 m × 1.5 m with doors, cupboards and what stands about.
struct OfficeConfig {
  static constexpr std::string_view kType = "office";

  int things = 5;          // cupboard, bin, plant, chair, boxes along the walls, at most
  int texture_size = 512;  // texels a side
  IndoorLightConfig light{};
};
void Describe(base::Description& d, OfficeConfig& c);

/// Streams "world/office", "world/masonry", "world/texture/…". No gates, no wind. Whatever stands leaves a way of
/// kOfficePassage past it.
inline constexpr double kOfficePassage = 0.75;  // m
World MakeWorld(const OfficeConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
