#pragma once

#include <cstdint>
#include <vector>

#include "stack/features/keypoint_grid.h"
#include "stack/interface/camera_model.h"
#include "stack/slam/map.h"
#include "stack/slam/map_config.h"

namespace alula::stack::slam {

/// A feature that shows a landmark.
struct LandmarkMatch {
  int landmark = 0;
  int feature = 0;
  int distance = 0;  // bits
};

/// Which features of a keyframe are looked at: those that show no landmark yet, or those that show one.
enum class Among : std::uint8_t { kFree, kTaken };

/// Landmarks that a keyframe should see from X_MB, looked for within `radius` px of where they should be: the nearest
/// descriptor of a fitting level, each feature once (the nearer descriptor wins). `landmarks`: none that it sees
/// already.
std::vector<LandmarkMatch> FindLandmarks(const Map& map, const Keyframe& keyframe, const base::Transform& X_MB,
                                         const std::vector<int>& landmarks, const features::KeypointGrid& grid,
                                         const CameraIntrinsics& camera, double radius, const MapConfig& config,
                                         Among among = Among::kFree);

}  // namespace alula::stack::slam
