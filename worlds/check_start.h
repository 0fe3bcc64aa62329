#pragma once

#include "worlds/world.h"

namespace alula::worlds {

/// Throws base::InputError where there is nothing to stand on at the start: no object that collides within 5 cm below
/// it, or, where a pad is there, nothing solid but the pad itself anywhere beneath.
void CheckStart(const World& world);

}  // namespace alula::worlds
