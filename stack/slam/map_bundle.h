#pragma once

#include <vector>

#include "stack/interface/camera_model.h"
#include "stack/slam/bundle_adjustment.h"
#include "stack/slam/map.h"
#include "stack/slam/map_config.h"

namespace alula::stack::slam {

/// A part of a map as a least-squares problem, and what its indices mean.
struct MapBundle {
  Bundle bundle;
  std::vector<int> keyframes;  // of bundle.poses
  std::vector<int> landmarks;  // of bundle.points
};

/// Keyframes that move and keyframes that hold, all landmarks that the moving ones see, the odometry's motions between
/// neighbours among them and its verticals. Both lists ascending, without common ids.
MapBundle MakeBundle(const Map& map, const std::vector<int>& moving, const std::vector<int>& holding,
                     const CameraIntrinsics& camera, const MapConfig& config);

/// Poses and places go back into the map; sights farther off than the gate go.
void TakeOver(const MapBundle& solved, Map& map, double gate);

/// How a feature sees its landmark, for the pose of index `pose`.
Sight SightOf(const Keyframe& keyframe, int feature, int pose, const CameraIntrinsics& camera, const MapConfig& config);

}  // namespace alula::stack::slam
