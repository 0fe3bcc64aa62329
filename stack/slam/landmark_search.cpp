#include "stack/slam/landmark_search.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::slam {

using base::Transform;
using base::Vec2;
using base::Vec3;

FeatureGrid::FeatureGrid(const KeyframeFeatures& features, const CameraIntrinsics& camera)
    : features_(features), columns_(camera.width / kCell + 1), rows_(camera.height / kCell + 1) {
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t i = 0; i < features.size(); ++i) {
    const int x = std::clamp(static_cast<int>(features[i].pixel.x()) / kCell, 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>(features[i].pixel.y()) / kCell, 0, rows_ - 1);
    cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)].push_back(
        static_cast<int>(i));
  }
}

void FeatureGrid::Near(const Vec2& pixel, double radius, std::vector<int>& found) const {
  found.clear();
  const auto cell = [](double v, int count) {
    return std::clamp(static_cast<int>(std::floor(v / kCell)), 0, count - 1);
  };
  for (int y = cell(pixel.y() - radius, rows_); y <= cell(pixel.y() + radius, rows_); ++y) {
    for (int x = cell(pixel.x() - radius, columns_); x <= cell(pixel.x() + radius, columns_); ++x) {
      for (const int i :
           cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)]) {
        if ((features_[static_cast<std::size_t>(i)].pixel - pixel).squaredNorm() <= radius * radius) found.push_back(i);
      }
    }
  }
  std::sort(found.begin(), found.end());
}

namespace {

/// Where a landmark should be seen, and on which level; none where it should not.
struct Expected {
  Vec2 pixel;
  double level = 0.0;
};
std::optional<Expected> Expect(const Landmark& landmark, const Transform& X_ML, const CameraIntrinsics& camera,
                               const MatchConfig& config) {
  const Vec3 p_L = X_ML.Inverse() * landmark.p_M;
  if (p_L.z() < 0.1) return std::nullopt;
  const Vec3 back = X_ML.p - landmark.p_M;
  const double distance = back.norm();
  if (back.dot(landmark.normal) < std::cos(config.max_angle) * distance) return std::nullopt;
  const Vec2 pixel = Project(camera, p_L);
  if (!Inside(camera, pixel, 0.0)) return std::nullopt;
  // What was seen on level n at distance d is as large on level n + log(d / d') / log(scale) at distance d'.
  return Expected{pixel,
                  landmark.reference_level + std::log(landmark.reference_distance / distance) / std::log(kLevelScale)};
}

}  // namespace

std::vector<LandmarkMatch> FindLandmarks(const Map& map, const Keyframe& keyframe, const Transform& X_MB,
                                         const std::vector<int>& landmarks, const FeatureGrid& grid,
                                         const CameraIntrinsics& camera, double radius, const MatchConfig& config) {
  const Transform X_ML = X_MB * map.eyes.X_BL;
  std::vector<LandmarkMatch> best_of(keyframe.features.size(), LandmarkMatch{-1, 0, 0});
  std::vector<int> near;
  for (const int id : landmarks) {
    const Landmark& landmark = map.landmark(id);
    const std::optional<Expected> expected = Expect(landmark, X_ML, camera, config);
    if (!expected) continue;
    const double scale = std::pow(kLevelScale, std::clamp(expected->level, 0.0, 7.0));
    grid.Near(expected->pixel, radius * scale, near);
    int best = -1, distance = config.max_distance + 1, second = 257;
    for (const int i : near) {
      const KeyframeFeature& feature = keyframe.features[static_cast<std::size_t>(i)];
      if (keyframe.landmarks[static_cast<std::size_t>(i)] >= 0) continue;
      if (std::abs(feature.level - expected->level) > 1.6) continue;
      const int d = features::HammingDistance(feature.descriptor, landmark.descriptor);
      if (d < distance) {
        second = best >= 0 ? distance : second;
        distance = d;
        best = i;
      } else if (d < second) {
        second = d;
      }
    }
    if (best < 0 || distance > config.ratio * second) continue;
    LandmarkMatch& taken = best_of[static_cast<std::size_t>(best)];
    if (taken.landmark < 0 || distance < taken.distance) taken = {id, best, distance};
  }
  std::erase_if(best_of, [](const LandmarkMatch& m) { return m.landmark < 0; });
  return best_of;
}

}  // namespace alula::stack::slam
