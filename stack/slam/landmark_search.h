#pragma once

#include <vector>

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

/// Features of a keyframe sorted into cells of the image, to be found by place.
class FeatureGrid {
 public:
  FeatureGrid(const KeyframeFeatures& features, const CameraIntrinsics& camera);
  /// Indices of features within `radius` px of a pixel, ascending.
  void Near(const base::Vec2& pixel, double radius, std::vector<int>& found) const;

 private:
  static constexpr int kCell = 24;  // px
  const KeyframeFeatures& features_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

/// Landmarks that a keyframe should see from X_MB, looked for within `radius` px of where they should be: the nearest
/// descriptor of a fitting level, each feature and landmark once (the nearer descriptor wins). Landmarks that the
/// keyframe has already are left out, as are features that have one.
std::vector<LandmarkMatch> FindLandmarks(const Map& map, const Keyframe& keyframe, const base::Transform& X_MB,
                                         const std::vector<int>& landmarks, const FeatureGrid& grid,
                                         const CameraIntrinsics& camera, double radius, const MatchConfig& config);

}  // namespace alula::stack::slam
