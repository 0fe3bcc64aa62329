#pragma once

#include <cstdint>
#include <string_view>

#include "worlds/weather.h"

namespace alula::worlds {

// Two of the five scenes that paper P2 landed in (figures 5 to 7): town landscapes, 48 m × 48 m. The start is a pad at
// the southern border; the target lies 18 m above the middle. Street lamps burn at dusk and at night.

/// Scene 4: a paved square with five obstacles spread evenly over it, three carved walls and two long stone benches;
/// regular buildings around.
struct LandingSquareConfig {
  static constexpr std::string_view kType = "landing_square";

  double ring = 9.0;    // m, of the circle on which the obstacles stand
  int storeys_min = 3;  // of the buildings
  int storeys_max = 6;
  WeatherConfig weather;
};
void Describe(base::Description& d, LandingSquareConfig& c);
World MakeWorld(const LandingSquareConfig& config, std::uint64_t seed);

/// Scene of figure 5: a round flower bed with large half-round beds about it, on which trees, shrubs and flowers grow;
/// three cars parked before it; the other half is an empty square.
struct LandingFlowerbedsConfig {
  static constexpr std::string_view kType = "landing_flowerbeds";

  int cars = 3;
  int trees = 12;
  double plants_per_m2 = 3.5;  // flowers and weeds on the beds
  WeatherConfig weather;
};
void Describe(base::Description& d, LandingFlowerbedsConfig& c);
World MakeWorld(const LandingFlowerbedsConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
