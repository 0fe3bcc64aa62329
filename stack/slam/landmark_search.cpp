#include "stack/slam/landmark_search.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::slam {

using base::Transform;
using base::Vec2;
using base::Vec3;

namespace {

/// Where a landmark should be seen, and on which octave; none where it should not.
struct Expected {
  Vec2 pixel;
  double octave = 0.0;
};
std::optional<Expected> Expect(const Landmark& landmark, const Transform& X_ML, const CameraIntrinsics& camera,
                               const MapConfig& config) {
  const Vec3 p_L = X_ML.Inverse() * landmark.p_M;
  if (p_L.z() < 0.1) return std::nullopt;
  const Vec3 back = X_ML.p - landmark.p_M;
  const double distance = back.norm();
  if (back.dot(landmark.normal) < std::cos(config.search.max_angle) * distance) return std::nullopt;
  const Vec2 pixel = Project(camera, p_L);
  if (!Inside(camera, pixel, 0.0)) return std::nullopt;
  // What was seen on octave n at distance d is as large on octave n + log(d / d') / log(scale) at distance d'.
  return Expected{
      pixel, landmark.reference_octave + std::log(landmark.reference_distance / distance) / std::log(config.orb.scale)};
}

}  // namespace

std::vector<LandmarkMatch> FindLandmarks(const Map& map, const Keyframe& keyframe, const Transform& X_MB,
                                         const std::vector<int>& landmarks, const features::KeypointGrid& grid,
                                         const CameraIntrinsics& camera, double radius, const MapConfig& config,
                                         Among among) {
  const Transform X_ML = X_MB * map.eyes.X_BL;
  std::vector<LandmarkMatch> best_of(keyframe.features.size(), LandmarkMatch{-1, 0, 0});
  for (const int id : landmarks) {
    const Landmark& landmark = map.landmark(id);
    const std::optional<Expected> expected = Expect(landmark, X_ML, camera, config);
    if (!expected) continue;
    const double octave = std::clamp(expected->octave, 0.0, config.orb.levels - 1.0);
    const double scale = std::pow(config.orb.scale, octave);
    int best = -1, distance = config.search.max_distance + 1, second = 257;
    for (const int i : grid.Around(expected->pixel, radius * scale)) {
      const KeyframeFeature& feature = keyframe.features[static_cast<std::size_t>(i)];
      if ((keyframe.landmarks[static_cast<std::size_t>(i)] >= 0) != (among == Among::kTaken)) continue;
      if (std::abs(feature.octave - expected->octave) > 1.6) continue;
      const int d = features::HammingDistance(feature.descriptor, landmark.descriptor);
      if (d < distance) {
        second = best >= 0 ? distance : second;
        distance = d;
        best = i;
      } else if (d < second) {
        second = d;
      }
    }
    if (best < 0 || distance > config.search.ratio * second) continue;
    LandmarkMatch& taken = best_of[static_cast<std::size_t>(best)];
    if (taken.landmark < 0 || distance < taken.distance) taken = {id, best, distance};
  }
  std::erase_if(best_of, [](const LandmarkMatch& m) { return m.landmark < 0; });
  return best_of;
}

}  // namespace alula::stack::slam
