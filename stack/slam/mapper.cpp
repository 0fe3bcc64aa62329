#include "stack/slam/mapper.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "stack/slam/landmark_search.h"
#include "stack/slam/map_bundle.h"

namespace alula::stack::slam {

using base::Transform;
using base::Vec3;

namespace {

constexpr int kLeastShared = 12;         // landmarks that make two keyframes neighbours
constexpr std::size_t kLookAround = 30;  // keyframes whose landmarks are looked for
constexpr double kNearby = 4.0;          // m, of keyframes that may see the same from another side
constexpr double kSameView = 0.3;        // cosine of the angle between their optical axes
constexpr int kProbation = 3;            // keyframes after which a landmark must have been seen again

Vec3 OpticalAxis(const Map& map, const Transform& X_MB) { return X_MB.q * (map.eyes.X_BL.q * Vec3::UnitZ()); }

std::vector<base::Vec2> PixelsOf(const PlaceView& view) {
  std::vector<base::Vec2> pixels;
  for (const PlacePoint& point : view.points) pixels.push_back(point.pixel);
  return pixels;
}

/// What the right eye measured, taken back from the depths that were made of it.
std::vector<std::optional<base::Vec2>> SeenByRightEye(const PlaceView& view, const Transform& X_LR) {
  const Transform X_RL = X_LR.Inverse();
  std::vector<std::optional<base::Vec2>> right(view.points.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (!view.points[i].p_C) continue;
    const Vec3 p_R = X_RL * *view.points[i].p_C;
    if (p_R.z() > 0.0) right[i] = base::Vec2(p_R.head<2>() / p_R.z());
  }
  return right;
}

/// One motion after the other.
RelativeMotion Compose(const RelativeMotion& a, const RelativeMotion& b) {
  RelativeMotion both;
  both.X_FT = a.X_FT * b.X_FT;
  both.sigma = (a.sigma.cwiseAbs2() + b.sigma.cwiseAbs2()).cwiseSqrt();
  return both;
}

}  // namespace

Mapper::Mapper(const features::StereoRig& rig, const MapConfig& config, std::shared_ptr<const Vocabulary> vocabulary,
               Map known)
    : rig_(rig), config_(config), map_(std::move(known)), dropped_(map_.keyframes.size()) {
  if (vocabulary == nullptr || !config.loop.enabled) return;
  places_.emplace(config.loop, std::move(vocabulary));
  places_->Remember(map_);
}

KeyframeReport Mapper::Add(KeyframeInput input) {
  KeyframeReport report;
  auto owned = std::make_unique<Keyframe>();
  Keyframe& keyframe = *owned;
  keyframe.id = report.keyframe = static_cast<int>(map_.keyframes.size());
  keyframe.seq = input.seq;
  keyframe.stamp = input.stamp;
  keyframe.X_OB = input.X_OB;
  keyframe.X_MB = X_MO_ * input.X_OB;
  map_.eyes = input.eyes;
  keyframe.up_B.reset();
  if (input.upright) keyframe.up_B = input.X_OB.q.conjugate() * Vec3::UnitZ();
  keyframe.view = std::move(input.view);
  if (keyframe.up_B) keyframe.view.up_C = map_.eyes.X_BL.q.conjugate() * *keyframe.up_B;
  keyframe.right = SeenByRightEye(keyframe.view, rig_.X_LR);
  keyframe.landmarks.assign(keyframe.view.points.size(), -1);
  TakeMotions(input, keyframe);
  const bool goes_on = keyframe.from_previous.has_value();
  if (goes_on) {
    keyframe.part = map_.keyframe(keyframe.previous).part;
  } else {
    keyframe.part = static_cast<int>(map_.anchors.size());
    map_.anchors.push_back(keyframe.id);
    claims_.clear();
  }
  map_.keyframes.push_back(std::move(owned));
  dropped_.emplace_back();
  if (goes_on) report.matched = Recognise(keyframe, report);
  CreateLandmarks(keyframe, report);
  if (report.matched > 0) FuseDuplicates(keyframe);
  newest_ = keyframe.id;
  const int every = config_.adjust.whole_every;
  if (every > 0 && keyframe.id % every == every - 1) {
    AdjustPart(keyframe.part, config_.adjust.whole_iterations, 1e-3);
  } else {
    AdjustAround(keyframe.id);
  }
  if (places_) LookForLoop(keyframe, report);
  X_MO_ = report.X_MO = OffsetOf(keyframe, keyframe.X_MB, keyframe.X_OB);
  DropPoorLandmarks(keyframe.id);
  DropRedundantKeyframes(keyframe.id);
  return report;
}

/// The odometry still improves what it has in its window: motions between its keyframes are taken anew.
void Mapper::TakeMotions(const KeyframeInput& input, Keyframe& keyframe) {
  const AdjustConfig& a = config_.adjust;
  Keyframe* to = &keyframe;
  Transform X_OT = input.X_OB;
  int from_id = newest_;
  for (auto it = input.window.rbegin(); it != input.window.rend() && from_id >= 0; ++it) {
    const Keyframe& from = map_.keyframe(from_id);
    if (from.stamp != it->stamp) return;  // one of them was dropped
    RelativeMotion motion;
    motion.X_FT = it->X_OB.Inverse() * X_OT;
    const double way = motion.X_FT.p.norm(), time = (to->stamp - from.stamp).Seconds();
    motion.sigma << Vec3::Constant(a.motion_position + a.motion_drift * way),
        Vec3::Constant(a.motion_angle + a.motion_angle_drift * time);
    to->from_previous = motion;
    to->previous = from_id;
    if (to->up_B) to->up_B = X_OT.q.conjugate() * Vec3::UnitZ();
    if (to == &keyframe) keyframe.X_MB = from.X_MB * motion.X_FT;
    X_OT = it->X_OB;
    to = &map_.keyframe(from_id);
    from_id = to->previous;
  }
}

std::vector<int> Mapper::LandmarksAround(int centre, const Transform& X_MB) const {
  std::vector<int> around{centre};
  for (const Covisible& c : CovisibleWith(map_, centre, kLeastShared)) {
    if (around.size() < kLookAround / 2) around.push_back(c.keyframe);
  }
  std::vector<std::pair<double, int>> near;
  const int part = map_.keyframe(centre).part;
  const Vec3 axis = OpticalAxis(map_, X_MB);
  for (const auto& other : map_.keyframes) {
    if (!other || other->part != part) continue;
    const double distance = (other->X_MB.p - X_MB.p).norm();
    if (distance < kNearby && OpticalAxis(map_, other->X_MB).dot(axis) > kSameView)
      near.emplace_back(distance, other->id);
  }
  std::sort(near.begin(), near.end());
  for (const auto& [distance, id] : near) {
    if (around.size() >= kLookAround) break;
    if (std::find(around.begin(), around.end(), id) == around.end()) around.push_back(id);
  }
  std::set<int> landmarks;
  for (const int id : around) {
    for (const int l : map_.keyframe(id).landmarks) {
      if (l >= 0) landmarks.insert(l);
    }
  }
  return {landmarks.begin(), landmarks.end()};
}

int Mapper::Recognise(Keyframe& keyframe, KeyframeReport& report) {
  const std::vector<int> landmarks = LandmarksAround(newest_, keyframe.X_MB);
  report.looked_for = static_cast<int>(landmarks.size());
  const features::KeypointGrid grid(PixelsOf(keyframe.view), rig_.left.width, rig_.left.height);
  std::vector<LandmarkMatch> matches;
  Transform X_MB = keyframe.X_MB;
  for (const double radius : {config_.search.radius, config_.search.near_radius}) {
    matches = FindLandmarks(map_, keyframe, X_MB, landmarks, grid, rig_.left, radius, config_);
    if (static_cast<int>(matches.size()) < config_.search.least) return 0;
    const std::optional<Transform> refined = Refine(keyframe, X_MB, matches, true);
    if (!refined) return 0;
    X_MB = *refined;
  }
  keyframe.X_MB = X_MB;
  for (const LandmarkMatch& m : matches) {
    AddSight(map_, m.landmark, keyframe.id, m.feature);
    RefreshLandmark(map_, m.landmark);
  }
  return static_cast<int>(matches.size());
}

std::optional<Transform> Mapper::Refine(const Keyframe& keyframe, const Transform& X_MB,
                                        std::vector<LandmarkMatch>& matches, bool with_motion) const {
  Bundle bundle;
  bundle.eyes = map_.eyes;
  bundle.poses.push_back({X_MB, false});
  if (keyframe.up_B) bundle.verticals.push_back({0, *keyframe.up_B, config_.adjust.vertical});
  if (with_motion && keyframe.from_previous) {
    const Keyframe& before = map_.keyframe(keyframe.previous);
    bundle.poses.push_back({before.X_MB, true});
    RelativeMotion motion = *keyframe.from_previous;
    motion.from = 1;
    motion.to = 0;
    bundle.motions.push_back(motion);
  }
  for (const LandmarkMatch& m : matches) {
    BundlePoint point{map_.landmark(m.landmark).p_M, {}, true};
    point.sights.push_back(SightOf(keyframe, m.feature, 0, rig_.left, config_));
    bundle.points.push_back(std::move(point));
  }
  const BundleOptions options{8, config_.adjust.huber, 1e-4};
  for (int round = 0; round < 2; ++round) {
    Adjust(bundle, options);
    std::vector<LandmarkMatch> kept;
    std::vector<BundlePoint> points;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const BundlePoint& point = bundle.points[i];
      const auto r = ResidualOf(bundle.poses[0].X_MB, map_.eyes, point.sights[0], point.p_M);
      if (!r || r->norm() > config_.adjust.gate) continue;
      kept.push_back(matches[i]);
      points.push_back(point);
    }
    matches = std::move(kept);
    bundle.points = std::move(points);
    if (static_cast<int>(matches.size()) < config_.search.least) return std::nullopt;
  }
  return bundle.poses[0].X_MB;
}

void Mapper::CreateLandmarks(Keyframe& keyframe, KeyframeReport& report) {
  const Transform X_ML = keyframe.X_MB * map_.eyes.X_BL;
  for (std::size_t i = 0; i < keyframe.view.points.size(); ++i) {
    if (keyframe.landmarks[i] >= 0 || !keyframe.right[i]) continue;
    const base::Vec2& left = keyframe.view.points[i].normalised;
    const double depth = features::TriangulatedDepth(*map_.eyes.X_LR, left, *keyframe.right[i]);
    if (!(depth > 0.0 && depth < config_.farthest)) continue;
    AddLandmark(map_, keyframe.id, static_cast<int>(i), X_ML * Vec3(depth * left.homogeneous()));
    ++report.created;
  }
}

/// What was taken for new may be known from elsewhere: a landmark of the neighbourhood that should be seen where this
/// keyframe sees another one, and fits there, is the same.
void Mapper::FuseDuplicates(Keyframe& keyframe) {
  std::vector<int> others = LandmarksAround(keyframe.previous, keyframe.X_MB);
  std::erase_if(others, [&](int l) {
    const auto& sights = map_.landmark(l).sights;
    return !sights.empty() && sights.back().keyframe == keyframe.id;
  });
  const features::KeypointGrid grid(PixelsOf(keyframe.view), rig_.left.width, rig_.left.height);
  for (const LandmarkMatch& m : FindLandmarks(map_, keyframe, keyframe.X_MB, others, grid, rig_.left,
                                              config_.search.near_radius, config_, Among::kTaken)) {
    const int known = keyframe.landmarks[static_cast<std::size_t>(m.feature)];
    const Sight sight = SightOf(keyframe, m.feature, 0, rig_.left, config_);
    const auto r = ResidualOf(keyframe.X_MB, map_.eyes, sight, map_.landmark(m.landmark).p_M);
    if (known < 0 || !r || r->norm() > config_.adjust.gate) continue;
    FuseLandmarks(map_, std::max(known, m.landmark), std::min(known, m.landmark));
  }
}

void Mapper::AdjustAround(int id) {
  std::set<int> moving;
  const AdjustConfig& config = config_.adjust;
  for (int k = id; k >= 0 && static_cast<int>(moving.size()) < config.keyframes; k = map_.keyframe(k).previous)
    moving.insert(k);
  int others = 0;
  for (const Covisible& c : CovisibleWith(map_, id, kLeastShared)) {
    if (others < config.covisible && moving.insert(c.keyframe).second) ++others;
  }
  std::vector<int> seen_by(map_.keyframes.size(), 0);
  for (const int k : moving) {
    for (const int l : map_.keyframe(k).landmarks) {
      if (l < 0) continue;
      for (const Landmark::Sight& s : map_.landmark(l).sights) ++seen_by[static_cast<std::size_t>(s.keyframe)];
    }
  }
  std::vector<std::pair<int, int>> watchers;  // (−shared, id)
  for (std::size_t k = 0; k < seen_by.size(); ++k) {
    if (seen_by[k] > 0 && !moving.contains(static_cast<int>(k)))
      watchers.emplace_back(-seen_by[k], static_cast<int>(k));
  }
  std::sort(watchers.begin(), watchers.end());
  std::set<int> holding;
  // A part of the map hangs on its first keyframe.
  const int anchor = map_.anchors[static_cast<std::size_t>(map_.keyframe(id).part)];
  if (moving.contains(anchor)) holding.insert(anchor);
  for (const auto& [shared, k] : watchers) {
    if (static_cast<int>(holding.size()) < config.fixed) holding.insert(k);
  }
  if (holding.empty()) holding.insert(*moving.begin());
  for (const int k : holding) moving.erase(k);
  if (moving.empty()) return;
  MapBundle part =
      MakeBundle(map_, {moving.begin(), moving.end()}, {holding.begin(), holding.end()}, rig_.left, config_);
  Adjust(part.bundle, {config.iterations, config.huber, 1e-3});
  TakeOver(part, map_, config.gate);
}

void Mapper::DropPoorLandmarks(int id) {
  // Born `kProbation` keyframes ago and seen by its parent alone: noise, or too far to matter.
  int parent = id;
  for (int i = 0; i < kProbation && parent >= 0; ++i) parent = map_.keyframe(parent).previous;
  if (parent < 0) return;
  for (const int l : std::vector<int>(map_.keyframe(parent).landmarks)) {
    if (l >= 0 && map_.landmark(l).born == parent && map_.landmark(l).sights.size() < 2) RemoveLandmark(map_, l);
  }
}

void Mapper::DropRedundantKeyframes(int id) {
  int guard = id;
  std::set<int> recent;
  for (int i = 0; i < config_.adjust.keyframes && guard >= 0; ++i, guard = map_.keyframe(guard).previous)
    recent.insert(guard);
  // Newer ones go first: what the map has long been built on stays.
  std::vector<int> neighbours;
  for (const Covisible& c : CovisibleWith(map_, id, kLeastShared)) neighbours.push_back(c.keyframe);
  std::sort(neighbours.rbegin(), neighbours.rend());
  for (const int neighbour : neighbours) {
    const Keyframe& keyframe = map_.keyframe(neighbour);
    const int anchor = map_.anchors[static_cast<std::size_t>(keyframe.part)];
    if (neighbour == anchor || recent.contains(neighbour)) continue;
    int all = 0, redundant = 0;
    for (const int l : keyframe.landmarks) {
      if (l < 0) continue;
      ++all;
      redundant += map_.landmark(l).sights.size() > 3 ? 1 : 0;
    }
    if (all > 0 && redundant > config_.redundant * all) Drop(neighbour);
  }
}

void Mapper::Drop(int id) {
  Keyframe& keyframe = map_.keyframe(id);
  for (const int l : std::vector<int>(keyframe.landmarks)) {
    if (l >= 0) RemoveSight(map_, l, id);
  }
  int heir = keyframe.previous;
  for (const auto& other : map_.keyframes) {
    if (!other || other->previous != id) continue;
    if (heir < 0) heir = other->id;
    other->previous = keyframe.previous;
    if (keyframe.from_previous && other->from_previous) {
      other->from_previous = Compose(*keyframe.from_previous, *other->from_previous);
    } else {
      other->from_previous.reset();
    }
  }
  if (heir < 0) heir = map_.anchors[static_cast<std::size_t>(keyframe.part)];
  dropped_[static_cast<std::size_t>(id)] = Dropped{heir, map_.keyframe(heir).X_MB.Inverse() * keyframe.X_MB};
  if (places_) places_->Forget(id);
  map_.keyframes[static_cast<std::size_t>(id)].reset();
}

Transform Mapper::PoseOf(int id) const {
  Transform X_KB;  // of the asked one in keyframe `id`
  while (dropped_[static_cast<std::size_t>(id)]) {
    const Dropped& step = *dropped_[static_cast<std::size_t>(id)];
    X_KB = step.X_HB * X_KB;
    id = step.heir;
  }
  return map_.keyframe(id).X_MB * X_KB;
}

void Mapper::Finish() {
  for (std::size_t part = 0; part < map_.anchors.size(); ++part) {
    if (map_.anchors[part] < 0) continue;
    for (int round = 0; round < 2; ++round) AdjustPart(static_cast<int>(part), config_.adjust.final_iterations, 1e-5);
  }
}

void Mapper::AdjustPart(int part, int iterations, double tolerance) {
  const int anchor = map_.anchors[static_cast<std::size_t>(part)];
  std::vector<int> moving;
  for (const auto& keyframe : map_.keyframes) {
    if (keyframe && keyframe->part == part && keyframe->id != anchor) moving.push_back(keyframe->id);
  }
  if (moving.empty()) return;
  MapBundle whole = MakeBundle(map_, moving, {anchor}, rig_.left, config_);
  Adjust(whole.bundle, {iterations, config_.adjust.huber, tolerance});
  TakeOver(whole, map_, config_.adjust.gate);
}

}  // namespace alula::stack::slam
