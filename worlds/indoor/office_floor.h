#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/kit/indoor_light.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A floor of 20 m × 15 m (paper P1): rooms on both sides of a corridor, doorways of 0.7, 0.8 and 0.9 m, glass doors,
/// desks, chairs, shelves, windows, people.
struct OfficeFloorConfig {
  static constexpr std::string_view kType = "office_floor";

  int rooms = 3;              // on each side of the corridor
  int glass_doors = 2;        // of the doors, that stand open as panes of satin glass
  int people = 0;             // who walk the corridor
  double people_speed = 1.1;  // m/s
  bool reactive = true;       // they heed the vehicle
  int texture_size = 512;     // texels a side of large surfaces; the rest has half
  IndoorLightConfig light{};
};
void Describe(base::Description& d, OfficeFloorConfig& c);

/// Clear widths that a floor's doorways are dealt from, m.
inline constexpr std::array<double, 3> kDoorWidths{0.7, 0.8, 0.9};

/// Streams "world/floor", "world/furniture", "world/masonry", "world/actors/…", "world/texture/…". No gates, no wind.
/// Doorway i (named "door<i>/left", "/right", "/head") has a clear width of exactly one of kDoorWidths; each width
/// occurs. The vehicle starts in the corridor's west end; the target is in the room farthest from it.
/// Throws base::InputError where so many people find no room.
World MakeWorld(const OfficeFloorConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
