#pragma once

#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/kit/indoor_light.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A machine hall as in EuRoC's MH sequences: 26 m × 15 m × 8.5 m of concrete with steel columns and girders, a crane,
/// turbines, tanks, cabinets, pipe runs along the walls, a gallery of gratings, drums and crates; dark beneath.
struct MachineHallConfig {
  static constexpr std::string_view kType = "machine_hall";

  int machines = 5;         // large ones along the aisle, at most
  int tanks = 5;            // at most
  int pipe_runs = 6;        // on the walls
  int clutter = 16;         // drums, crates and cabinets, at most
  bool bare_walls = false;  // white walls without pipes, panels and pictures
  int texture_size = 512;   // texels a side of large surfaces; the rest has half
  IndoorLightConfig light{};
};
void Describe(base::Description& d, MachineHallConfig& c);

/// Streams "world/hall", "world/things", "world/masonry", "world/texture/…". No gates, no wind. The vehicle starts on a
/// pad at the west end of the aisle and the target hangs at its east end.
World MakeWorld(const MachineHallConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
