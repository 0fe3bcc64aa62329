#pragma once

#include <string>

#include "worlds/world.h"

namespace alula::scenarios {

/// The true geometry of a run for those who want to score it themselves: gates, pad, target, wind and every object with
/// shape, size and pose; metres, quaternions as w x y z.
std::string WorldToJson(const worlds::World& world);

}  // namespace alula::scenarios
