#pragma once

#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/weather.h"
#include "worlds/world.h"

namespace alula::worlds {

/// 100 m × 100 m of flat ground between walls. The way leads from one corner to the opposite one: 113 m as the crow
/// flies (P0, section 5.3, gives 115 to 129 m of path).
struct PlanningMapConfig {
  static constexpr std::string_view kType = "planning_map";
  enum class Layout { kOpen, kCorridors, kCluttered };

  Layout layout = Layout::kOpen;
  int obstacles = 40;           // open and cluttered: at most; what finds no free place is left out
  double radius_min = 1.0;      // m, of the circle that an obstacle fits in
  double radius_max = 4.0;      // m
  double gap = 3.0;             // m, least between two obstacles
  int barriers = 5;             // corridors: walls across the way
  int passages = 2;             // through each of them
  double corridor_width = 2.0;  // m
  double corridor_min = 3.0;    // m, length of a corridor: thickness of its barrier
  double corridor_max = 8.0;    // m
  double height = 6.0;          // m, of walls and obstacles; the bounds end 1 m below
  int texture_size = 512;       // texels a side
  WeatherConfig weather{};
};
void Describe(base::Description& d, PlanningMapConfig& c);

inline constexpr double kMapHalf = 50.0;    // m, half of the side
inline constexpr double kMapCorner = 40.0;  // m: start at (−40, −40), target at (40, 40)

/// Streams "world/map", "world/masonry", "world/texture/…", and those of the weather. Promises
/// (tests/worlds/planning_map_test.cpp): from start to target there is a way that keeps 0.5 m from everything, and
/// corridors are exactly as wide as configured.
World MakeWorld(const PlanningMapConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
