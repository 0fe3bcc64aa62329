#pragma once

#include "base/hash.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Feeds all of a world that a run can feel or see (geometry, textures, gates, wind, light, start) to `hash`.
void AddTo(base::RollingHash& hash, const World& world);

}  // namespace alula::worlds
