#pragma once

#include <cstdint>
#include <string_view>

#include "worlds/weather.h"

namespace alula::worlds {

// Three of the five scenes that paper P2 landed in (3.3, figure 7): field landscapes, 48 m × 48 m, seen from 20 m. The
// start is a pad at the southern border; the target lies 18 m above the middle.

/// Scene 1: a small wood with one clearing that is fit to land in.
struct LandingForestConfig {
  static constexpr std::string_view kType = "landing_forest";

  int trees = 80;                // at most
  double tree_height_min = 5.0;  // m
  double tree_height_max = 8.0;  // m
  double clearing_min = 3.5;     // m, radius
  double clearing_max = 5.0;     // m
  double unevenness = 0.12;      // m, 1σ of the ground's bumps under the trees
  WeatherConfig weather;
};
void Describe(base::Description& d, LandingForestConfig& c);
World MakeWorld(const LandingForestConfig& config, std::uint64_t seed);

/// Scene 2: a hillside with boulders, trees around, a large standing figure in its middle, and flatter ground at its
/// foot.
struct LandingSlopeConfig {
  static constexpr std::string_view kType = "landing_slope";

  double slope = 0.29;  // rad, of the hillside
  int boulders = 22;
  int trees = 26;
  double sculpture_height = 3.6;  // m, with its plinth
  WeatherConfig weather;
};
void Describe(base::Description& d, LandingSlopeConfig& c);
World MakeWorld(const LandingSlopeConfig& config, std::uint64_t seed);

/// Scene 3: farm land: flat grass in the middle, some trees and shrubs, a ploughed strip.
struct LandingFieldConfig {
  static constexpr std::string_view kType = "landing_field";

  int trees = 9;
  int shrubs = 60;
  double furrow_height = 0.16;  // m, of the ploughed strip's ridges
  WeatherConfig weather;
};
void Describe(base::Description& d, LandingFieldConfig& c);
World MakeWorld(const LandingFieldConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
