#pragma once

#include "base/frames.h"

namespace alula::stack::pilot {

// Where a point is with respect to a gate. p_G: in the gate's frame, m; x along the direction of passage.

enum class Crossing { kNone, kThrough, kBeside };

/// Distance from the gate's axis as a square opening sees it: max(|y|, |z|), m.
double OffAxis(const base::Vec3& p_G);

/// How the step from `before_G` to `p_G` crossed the gate's plane, forwards: inside the opening (side in m), beside it,
/// or not at all. A crossing far beside is none: the plane is endless, and the course leads round behind gates.
Crossing CrossingOf(const base::Vec3& before_G, const base::Vec3& p_G, double opening);

/// So near before the opening that the frame leaves the cameras' view, and its fit should be kept as it is.
bool FrameLeavesView(const base::Vec3& p_G, double freeze_distance);

/// Whether the straight flight after the gate is over (or the gate is far away, after a detour).
bool CorridorLeft(const base::Vec3& p_G, double passage_after);

}  // namespace alula::stack::pilot
