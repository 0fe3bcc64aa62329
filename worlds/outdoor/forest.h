#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/frames.h"
#include "worlds/weather.h"

namespace alula::worlds {

/// A thin wood as paper P3 flew through (4.B): trees that look alike on uneven ground, whose crowns shade it in
/// patches. The start is a pad at its western side; the target lies at the eastern one, 2 m up as P3 flew.
struct ForestConfig {
  static constexpr std::string_view kType = "forest";

  int trees = 64;                 // in the 64 m × 64 m of the field, at most
  double tree_height_min = 6.5;   // m
  double tree_height_max = 10.0;  // m
  double spacing = 3.0;           // least distance between stems, m
  double conifers = 0.25;         // share of the tree models that are conifers
  double unevenness = 0.12;       // m, 1σ of the ground's bumps
  int boulders = 8;
  int deadwood = 10;  // logs and stumps
  int shrubs = 24;
  std::vector<base::Vec3> trail;  // m: corners of a way on which nothing stands; their height does not matter
  double trail_width = 4.0;       // m
  WeatherConfig weather;
};
void Describe(base::Description& d, ForestConfig& c);
World MakeWorld(const ForestConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
