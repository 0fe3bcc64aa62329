#pragma once

#include <string>

#include "worlds/world.h"

namespace alula::scenarios {

/// The true geometry of a run for those who want to score it themselves: gates, pad, target, wind and every object with
/// shape, size and pose; metres, quaternions as w x y z. Links of actors with their shapes, where there are any:
/// actors.csv has their poses; meshes of theirs collide as convex hulls.
std::string WorldToJson(const worlds::World& world);

}  // namespace alula::scenarios
