#pragma once

#include <span>

#include "base/random.h"
#include "base/time.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/actors/outline.h"

namespace alula::worlds {

/// Another actor as its neighbours meet it.
struct Neighbour {
  Outline outline;
  base::Vec2 v{0.0, 0.0};  // m/s
  bool is_solid = false;   // else nobody need heed it
};

/// The first coordinates of a motion, from which the pose of joint 0 follows.
inline constexpr std::size_t kRootCoordinates = 6;

/// All that an actor may heed during one tick.
struct ActorSurroundings {
  base::Time now;  // the tick's begin
  double dt = 0.01;
  const ActorStimulus& vehicle;
  std::span<const Neighbour> others;  // by actor, this one too
  std::size_t self = 0;
  std::span<const Outline> outlines;
  base::RandomStream& random;  // this actor's
};

}  // namespace alula::worlds
