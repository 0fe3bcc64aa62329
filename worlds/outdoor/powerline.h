#pragma once

#include <cstdint>
#include <string_view>

#include "worlds/weather.h"

namespace alula::worlds {

/// A stretch of overhead line as paper P4 inspects it: three lattice towers, conductors and an earth wire that hang as
/// catenaries, insulator strings, and things that the wind has hung on the line. It runs along x; the start is a pad
/// beside it, the target lies before the first thing on the line.
struct PowerlineConfig {
  static constexpr std::string_view kType = "powerline";

  double span = 66.0;          // m between towers
  double tower_height = 22.0;  // m
  double tension = 6.0e3;      // N, horizontal, of a conductor
  double weight = 9.04;        // N/m, of a conductor: LGJ-240/30 (aluminium on steel) has 0.922 kg/m
  double diameter = 0.0216;    // m, of the same
  int kites = 1;               // that hang on the line
  int balloons = 1;
  int bags = 1;
  int branches = 1;
  int trees = 30;  // beside the corridor
  WeatherConfig weather;
};
void Describe(base::Description& d, PowerlineConfig& c);
World MakeWorld(const PowerlineConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
