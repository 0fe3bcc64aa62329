#pragma once

#include <optional>

#include "base/frames.h"
#include "sim/truth.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/world.h"

namespace alula::sim {

/// Where the body origin crosses a gate's plane inside the opening; a swinging gate's where it is then.
struct GateCrossing {
  base::Vec3 p_GB = base::Vec3::Zero();  // gate frame, m
  bool forward = false;
};
/// The crossing that happened over a step of the truth, if any (motion within a step as a straight line).
std::optional<GateCrossing> CrossingOf(const worlds::Gate& gate, const worlds::ActorSimulation& actors,
                                       const TruthWindow& truth);

}  // namespace alula::sim
