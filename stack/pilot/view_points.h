#pragma once

#include <vector>

#include "base/frames.h"

namespace alula::stack::pilot {

/// Places from which a gate can be looked at, on the side that it is entered from, best first: straight before it at
/// `distance` (m), nearer, to both sides, farther. `look` rotates the list, so that each look in vain tries another.
/// Never lower than 0.7 m above the ground.
std::vector<base::Vec3> ViewPoints(const base::Transform& X_OG, double distance, int look, double ground_O);

}  // namespace alula::stack::pilot
