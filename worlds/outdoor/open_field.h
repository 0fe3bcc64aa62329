#pragma once

#include <cstdint>
#include <string_view>

#include "worlds/weather.h"

namespace alula::worlds {

/// Wide grass with one building, as paper P3 flew over at 1.5 m (4.C): hardly a feature but the grass itself.
struct OpenFieldConfig {
  static constexpr std::string_view kType = "open_field";

  double building_distance_min = 16.0;  // m from the pad
  double building_distance_max = 26.0;  // m
  double unevenness = 0.05;             // m, 1σ of the ground's bumps
  double contrast = 0.13;               // of the grass, of the palette's range (1σ)
  int tufts = 900;
  int waving_tufts = 200;  // that the vehicle's wash bends: half of them near the pad, half at the target
  WeatherConfig weather;
};
void Describe(base::Description& d, OpenFieldConfig& c);
World MakeWorld(const OpenFieldConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
