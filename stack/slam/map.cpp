#include "stack/slam/map.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>

namespace alula::stack::slam {

using base::Vec3;

std::vector<Covisible> CovisibleWith(const Map& map, int id, int least) {
  std::map<int, int> shared;
  for (const int l : map.keyframe(id).landmarks) {
    if (l < 0) continue;
    for (const Landmark::Sight& sight : map.landmark(l).sights) {
      if (sight.keyframe != id) ++shared[sight.keyframe];
    }
  }
  std::vector<Covisible> result;
  for (const auto& [keyframe, count] : shared) {
    if (count >= least) result.push_back({keyframe, count});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Covisible& a, const Covisible& b) { return a.shared > b.shared; });
  return result;
}

int AddLandmark(Map& map, int keyframe, int feature, const Vec3& p_M) {
  const int id = static_cast<int>(map.landmarks.size());
  auto landmark = std::make_unique<Landmark>();
  landmark->part = map.keyframe(keyframe).part;
  landmark->p_M = p_M;
  landmark->born = keyframe;
  map.landmarks.push_back(std::move(landmark));
  AddSight(map, id, keyframe, feature);
  RefreshLandmark(map, id);
  return id;
}

void AddSight(Map& map, int landmark, int keyframe, int feature) {
  auto& sights = map.landmark(landmark).sights;
  const auto at = std::lower_bound(sights.begin(), sights.end(), keyframe,
                                   [](const Landmark::Sight& s, int k) { return s.keyframe < k; });
  sights.insert(at, {keyframe, feature});
  map.keyframe(keyframe).landmarks[static_cast<std::size_t>(feature)] = landmark;
}

void RemoveSight(Map& map, int landmark, int keyframe) {
  auto& sights = map.landmark(landmark).sights;
  std::erase_if(sights, [&](const Landmark::Sight& s) {
    if (s.keyframe != keyframe) return false;
    map.keyframe(keyframe).landmarks[static_cast<std::size_t>(s.feature)] = -1;
    return true;
  });
  if (sights.empty()) map.landmarks[static_cast<std::size_t>(landmark)].reset();
}

void RemoveLandmark(Map& map, int landmark) {
  for (const Landmark::Sight& s : map.landmark(landmark).sights)
    map.keyframe(s.keyframe).landmarks[static_cast<std::size_t>(s.feature)] = -1;
  map.landmarks[static_cast<std::size_t>(landmark)].reset();
}

void FuseLandmarks(Map& map, int from, int into) {
  if (from == into) return;
  const std::vector<Landmark::Sight> sights = map.landmark(from).sights;
  RemoveLandmark(map, from);
  for (const Landmark::Sight& s : sights) {
    const auto& known = map.landmark(into).sights;
    const bool there =
        std::any_of(known.begin(), known.end(), [&s](const Landmark::Sight& k) { return k.keyframe == s.keyframe; });
    if (!there) AddSight(map, into, s.keyframe, s.feature);
  }
  RefreshLandmark(map, into);
}

void RefreshLandmark(Map& map, int id) {
  Landmark& landmark = map.landmark(id);
  Vec3 sum = Vec3::Zero();
  for (const Landmark::Sight& s : landmark.sights) {
    const Keyframe& keyframe = map.keyframe(s.keyframe);
    sum += (keyframe.X_MB * map.eyes.X_BL.p - landmark.p_M).normalized();
  }
  if (sum.norm() > 0) landmark.normal = sum.normalized();
  // The first sight gives the scale; the descriptor is the one that is nearest to all others (their median).
  const auto feature = [&map](const Landmark::Sight& s) -> const PlacePoint& {
    return map.keyframe(s.keyframe).view.points[static_cast<std::size_t>(s.feature)];
  };
  const Landmark::Sight& first = landmark.sights.front();
  const Keyframe& keyframe = map.keyframe(first.keyframe);
  landmark.reference_distance = (keyframe.X_MB * map.eyes.X_BL.p - landmark.p_M).norm();
  landmark.reference_scale = feature(first).scale;
  constexpr std::size_t kLooks = 8;  // newest sights that are compared
  const std::size_t begin = landmark.sights.size() > kLooks ? landmark.sights.size() - kLooks : 0;
  int best = std::numeric_limits<int>::max();
  for (std::size_t i = begin; i < landmark.sights.size(); ++i) {
    int worst = 0;
    const features::Descriptor& mine = feature(landmark.sights[i]).descriptor;
    for (std::size_t j = begin; j < landmark.sights.size(); ++j)
      worst = std::max(worst, features::HammingDistance(mine, feature(landmark.sights[j]).descriptor));
    if (worst < best) {
      best = worst;
      landmark.descriptor = mine;
    }
  }
}

}  // namespace alula::stack::slam
