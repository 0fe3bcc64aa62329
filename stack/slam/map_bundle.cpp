#include "stack/slam/map_bundle.h"

#include <algorithm>
#include <set>

namespace alula::stack::slam {

Sight SightOf(const Keyframe& keyframe, int feature, int pose, const CameraIntrinsics& camera,
              const MapConfig& config) {
  const auto i = static_cast<std::size_t>(feature);
  const PlacePoint& point = keyframe.view.points[i];
  return {pose, point.normalised, keyframe.right[i], config.adjust.pixel_sigma * point.scale / camera.fx};
}

MapBundle MakeBundle(const Map& map, const std::vector<int>& moving, const std::vector<int>& holding,
                     const CameraIntrinsics& camera, const MapConfig& config) {
  MapBundle made;
  made.bundle.eyes = map.eyes;
  std::merge(moving.begin(), moving.end(), holding.begin(), holding.end(), std::back_inserter(made.keyframes));
  std::vector<int> index(map.keyframes.size(), -1);
  std::set<int> landmarks;
  for (std::size_t i = 0; i < made.keyframes.size(); ++i) {
    const Keyframe& keyframe = map.keyframe(made.keyframes[i]);
    index[static_cast<std::size_t>(keyframe.id)] = static_cast<int>(i);
    const bool moves = std::binary_search(moving.begin(), moving.end(), keyframe.id);
    made.bundle.poses.push_back({keyframe.X_MB, !moves});
    if (!moves) continue;
    if (keyframe.up_B) made.bundle.verticals.push_back({static_cast<int>(i), *keyframe.up_B, config.adjust.vertical});
    for (const int l : keyframe.landmarks) {
      if (l >= 0) landmarks.insert(l);
    }
  }
  for (std::size_t i = 0; i < made.keyframes.size(); ++i) {
    const Keyframe& keyframe = map.keyframe(made.keyframes[i]);
    if (!keyframe.from_previous || keyframe.previous < 0) continue;
    const int from = index[static_cast<std::size_t>(keyframe.previous)];
    if (from < 0 || (made.bundle.poses[i].fixed && made.bundle.poses[static_cast<std::size_t>(from)].fixed)) continue;
    RelativeMotion motion = *keyframe.from_previous;
    motion.from = from;
    motion.to = static_cast<int>(i);
    made.bundle.motions.push_back(motion);
  }
  for (const int l : landmarks) {
    const Landmark& landmark = map.landmark(l);
    BundlePoint point;
    point.p_M = landmark.p_M;
    for (const Landmark::Sight& s : landmark.sights) {
      const int pose = index[static_cast<std::size_t>(s.keyframe)];
      if (pose >= 0) point.sights.push_back(SightOf(map.keyframe(s.keyframe), s.feature, pose, camera, config));
    }
    made.landmarks.push_back(l);
    made.bundle.points.push_back(std::move(point));
  }
  return made;
}

void TakeOver(const MapBundle& solved, Map& map, double gate) {
  for (std::size_t i = 0; i < solved.keyframes.size(); ++i) {
    if (!solved.bundle.poses[i].fixed) map.keyframe(solved.keyframes[i]).X_MB = solved.bundle.poses[i].X_MB;
  }
  for (std::size_t k = 0; k < solved.landmarks.size(); ++k) {
    const BundlePoint& point = solved.bundle.points[k];
    map.landmark(solved.landmarks[k]).p_M = point.p_M;
    for (const Sight& sight : point.sights) {
      const BundlePose& pose = solved.bundle.poses[static_cast<std::size_t>(sight.pose)];
      const auto r = ResidualOf(pose.X_MB, solved.bundle.eyes, sight, point.p_M);
      if (r && r->norm() <= gate) continue;
      RemoveSight(map, solved.landmarks[k], solved.keyframes[static_cast<std::size_t>(sight.pose)]);
    }
  }
}

}  // namespace alula::stack::slam
