#pragma once

#include "stack/slam/map.h"
#include "stack/slam/map_config.h"

namespace alula::stack::slam {

/// A place seen again: keyframe `now` shows what `then` shows.
struct Loop {
  int then = 0, now = 0;
  base::Transform X_TN;  // body of `now` in the body of `then`
};

/// The turn about the vertical and the shift that carry X_MB over to X_NB; tilt stays as it is.
base::Transform UprightOffset(const base::Transform& X_NB, const base::Transform& X_MB);

/// The same for a keyframe; where its vertical is not known the whole motion.
base::Transform OffsetOf(const Keyframe& keyframe, const base::Transform& X_NB, const base::Transform& X_MB);

/// Joins a part of the map to another: X_IP is the pose of the part's frame in the other's.
void JoinPart(Map& map, int part, int into, const base::Transform& X_IP);

/// Spreads the error that a loop shows over the way between: a pose graph over the keyframes of the part, tied by the
/// odometry's motions, by what they see in common and by the loop. Tilts are held as they are where gravity tells
/// them: four degrees of freedom a keyframe are left, six without an IMU (Qin et al. 2018, section VIII; ties by
/// covisibility: Mur-Artal et al. 2015). Landmarks go with the keyframe that saw them first.
void SpreadLoop(Map& map, const Loop& loop, const MapConfig& config);

}  // namespace alula::stack::slam
