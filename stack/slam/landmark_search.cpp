#include "stack/slam/landmark_search.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::slam {

using base::Transform;
using base::Vec2;
using base::Vec3;

namespace {

constexpr double kScales = 0.3;  // by which the logarithm of a point's scale may be off: an octave and a half of 1.2

/// Where a landmark should be seen, and on which scale of the pyramid; none where it should not.
struct Expected {
  Vec2 pixel;
  double scale = 1.0;
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
  // What is twice as far is half as large: it is found on a scale half as coarse.
  return Expected{pixel, landmark.reference_scale * landmark.reference_distance / distance};
}

}  // namespace

std::vector<LandmarkMatch> FindLandmarks(const Map& map, const Keyframe& keyframe, const Transform& X_MB,
                                         const std::vector<int>& landmarks, const features::KeypointGrid& grid,
                                         const CameraIntrinsics& camera, double radius, const MapConfig& config,
                                         Among among) {
  const Transform X_ML = X_MB * map.eyes.X_BL;
  const double coarsest = std::pow(config.orb.scale, config.orb.levels - 1);
  std::vector<LandmarkMatch> best_of(keyframe.view.points.size(), LandmarkMatch{-1, 0, 0});
  for (const int id : landmarks) {
    const Landmark& landmark = map.landmark(id);
    const std::optional<Expected> expected = Expect(landmark, X_ML, camera, config);
    if (!expected) continue;
    const double reach = radius * std::clamp(expected->scale, 1.0, coarsest);
    int best = -1, distance = config.search.max_distance + 1, second = 257;
    for (const int i : grid.Around(expected->pixel, reach)) {
      const PlacePoint& point = keyframe.view.points[static_cast<std::size_t>(i)];
      if ((keyframe.landmarks[static_cast<std::size_t>(i)] >= 0) != (among == Among::kTaken)) continue;
      if (std::abs(std::log(point.scale / expected->scale)) > kScales) continue;
      const int d = features::HammingDistance(point.descriptor, landmark.descriptor);
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
