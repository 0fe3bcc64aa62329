#include "stack/slam/map_correction.h"

#include <map>
#include <vector>

namespace alula::stack::slam {

using base::Transform;
using base::Vec3;

namespace {

constexpr int kTied = 40;               // landmarks that two keyframes share which are tied
constexpr std::size_t kTies = 8;        // of a keyframe, to older ones
constexpr double kHeldTilt = 1e-4;      // rad
constexpr double kLoopPosition = 0.02;  // m, 1σ: geometry of some dozens of points
constexpr double kLoopAngle = 0.005;    // rad

RelativeMotion Tie(int from, int to, const Transform& X_FT, double position, double angle) {
  RelativeMotion tie{from, to, X_FT, {}};
  tie.sigma << Vec3::Constant(position), Vec3::Constant(angle);
  return tie;
}

}  // namespace

Transform UprightOffset(const Transform& X_NB, const Transform& X_MB) {
  const base::Quat q = base::FromYaw(base::Yaw(X_NB.q * X_MB.q.conjugate()));
  return {q, X_NB.p - q * X_MB.p};
}

Transform OffsetOf(const Keyframe& keyframe, const Transform& X_NB, const Transform& X_MB) {
  return keyframe.up_B ? UprightOffset(X_NB, X_MB) : X_NB * X_MB.Inverse();
}

void JoinPart(Map& map, int part, int into, const Transform& X_IP) {
  for (const auto& keyframe : map.keyframes) {
    if (!keyframe || keyframe->part != part) continue;
    keyframe->part = into;
    keyframe->X_MB = X_IP * keyframe->X_MB;
  }
  for (const auto& landmark : map.landmarks) {
    if (!landmark || landmark->part != part) continue;
    landmark->part = into;
    landmark->p_M = X_IP * landmark->p_M;
    landmark->normal = X_IP.q * landmark->normal;
  }
  map.anchors[static_cast<std::size_t>(part)] = -1;
}

void SpreadLoop(Map& map, const Loop& loop, const MapConfig& config) {
  const int part = map.keyframe(loop.now).part;
  std::map<int, int> index;
  Bundle graph;
  for (const auto& keyframe : map.keyframes) {
    if (!keyframe || keyframe->part != part) continue;
    const int i = static_cast<int>(graph.poses.size());
    index[keyframe->id] = i;
    graph.poses.push_back({keyframe->X_MB, keyframe->id == map.anchors[static_cast<std::size_t>(part)]});
    if (keyframe->up_B) graph.verticals.push_back({i, keyframe->X_MB.q.conjugate() * Vec3::UnitZ(), kHeldTilt});
  }
  for (const auto& [id, to] : index) {
    const Keyframe& keyframe = map.keyframe(id);
    if (keyframe.from_previous && index.contains(keyframe.previous)) {
      RelativeMotion motion = *keyframe.from_previous;
      motion.from = index.at(keyframe.previous);
      motion.to = to;
      graph.motions.push_back(motion);
    }
    std::size_t ties = 0;
    for (const Covisible& c : CovisibleWith(map, id, kTied)) {
      if (c.keyframe >= id || ties >= kTies || !index.contains(c.keyframe)) continue;
      ++ties;
      graph.motions.push_back(Tie(index.at(c.keyframe), to, map.keyframe(c.keyframe).X_MB.Inverse() * keyframe.X_MB,
                                  config.loop.tie_position, config.loop.tie_angle));
    }
  }
  graph.motions.push_back(Tie(index.at(loop.then), index.at(loop.now), loop.X_TN, kLoopPosition, kLoopAngle));
  Adjust(graph, {20, config.adjust.huber, 1e-6});

  std::map<int, Transform> moved;  // by keyframe: from where it was to where it is
  for (const auto& [id, i] : index) {
    Keyframe& keyframe = map.keyframe(id);
    const Transform& X_MB = graph.poses[static_cast<std::size_t>(i)].X_MB;
    moved[id] = X_MB * keyframe.X_MB.Inverse();
    keyframe.X_MB = X_MB;
  }
  for (const auto& landmark : map.landmarks) {
    if (!landmark || landmark->part != part) continue;
    const Transform& X = moved.at(landmark->sights.front().keyframe);
    landmark->p_M = X * landmark->p_M;
    landmark->normal = X.q * landmark->normal;
  }
}

}  // namespace alula::stack::slam
