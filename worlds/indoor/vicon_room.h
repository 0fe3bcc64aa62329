#pragma once

#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "worlds/kit/indoor_light.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A motion-capture room as in EuRoC's V1 and V2: 8 m × 8.4 m × 4 m with carpet, windows behind curtains, gym mats
/// that lean on the walls, screens, printed rugs, tape with specks, targets and boxes.
struct ViconRoomConfig {
  static constexpr std::string_view kType = "vicon_room";

  int screens = 4;          // stacks of mats and upright boards that stand in the room, at most
  int boxes = 8;            // on the floor, at most
  int rugs = 4;             // printed, on the floor
  int strips = 9;           // of tape with specks
  bool bare_walls = false;  // white walls alone: no window, curtain, mat, picture
  int texture_size = 512;   // texels a side of large surfaces; the rest has half
  IndoorLightConfig light{};
};
void Describe(base::Description& d, ViconRoomConfig& c);

/// Streams "world/room", "world/things", "world/masonry", "world/texture/…", "world/print/…". No gates, no wind. It
/// starts on a pad in one corner region and the target hangs in the opposite one; things keep 1 m apart, so that ways
/// are passable.
World MakeWorld(const ViconRoomConfig& config, std::uint64_t seed);

}  // namespace alula::worlds
