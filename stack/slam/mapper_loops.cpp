#include <algorithm>
#include <cmath>

#include "stack/slam/map_bundle.h"
#include "stack/slam/mapper.h"

namespace alula::stack::slam {

using base::Transform;
using base::Vec3;

namespace {

constexpr int kFusedAround = 10;  // keyframes next to the newest that learn what the known place shows
constexpr int kSharedThere = 12;  // landmarks that make them so

double AngleBetween(const base::Quat& a, const base::Quat& b) { return base::Log(a.conjugate() * b).norm(); }

}  // namespace

void Mapper::LookForLoop(Keyframe& keyframe, KeyframeReport& report) {
  const std::optional<KnownPlace> place = places_->Look(map_, keyframe.id);
  if (!place) return;
  const std::optional<Claim> claim = Examine(keyframe, *place);
  if (!claim || !Confirmed(keyframe, *claim)) return;
  if (claim->part == keyframe.part) {
    SpreadLoop(map_, claim->loop, config_);
  } else {
    // The older part stays; what is newest goes over to it, or takes it in.
    const int older = std::min(claim->part, keyframe.part), newer = std::max(claim->part, keyframe.part);
    JoinPart(map_, newer, older, keyframe.part == newer ? claim->X_NM : claim->X_NM.Inverse());
    report.joined = true;
  }
  FuseAround(keyframe.id, claim->loop.then);
  AdjustAround(keyframe.id);
  AdjustPart(keyframe.part, config_.adjust.whole_iterations, 1e-3);
  report.loop = claim->loop;
  claims_.clear();
}

/// What geometry between two views says is looked at with all that the map knows around the known one.
std::optional<Mapper::Claim> Mapper::Examine(const Keyframe& keyframe, const KnownPlace& place) const {
  const Keyframe& then = map_.keyframe(place.keyframe);
  Transform X_MB = then.X_MB * place.X_KB;
  const std::vector<int> landmarks = LandmarksAround(then.id, X_MB);
  std::vector<LandmarkMatch> matches;
  for (const double radius : {config_.search.radius, config_.search.near_radius}) {
    matches = MatchAll(keyframe, X_MB, landmarks, radius);
    if (static_cast<int>(matches.size()) < config_.loop.least) return std::nullopt;
    const std::optional<Transform> refined = Refine(keyframe, X_MB, matches, false);
    if (!refined || static_cast<int>(matches.size()) < config_.loop.least) return std::nullopt;
    X_MB = *refined;
  }
  Claim claim;
  claim.loop = {then.id, keyframe.id, then.X_MB.Inverse() * X_MB};
  claim.X_NM = OffsetOf(keyframe, X_MB, keyframe.X_MB);
  claim.part = then.part;
  if (AngleBetween(X_MB.q, claim.X_NM.q * keyframe.X_MB.q) > config_.loop.tilt) return std::nullopt;
  if (claim.part == keyframe.part && !WithinDrift(keyframe, claim)) return std::nullopt;
  return claim;
}

bool Mapper::WithinDrift(const Keyframe& keyframe, const Claim& claim) const {
  const LoopConfig& c = config_.loop;
  double way = 0.0;
  for (const auto& other : map_.keyframes) {
    if (other && other->id > claim.loop.then && other->part == keyframe.part && other->from_previous)
      way += other->from_previous->X_FT.p.norm();
  }
  const double time = (keyframe.stamp - map_.keyframe(claim.loop.then).stamp).Seconds();
  const double moved = (claim.X_NM * keyframe.X_MB.p - keyframe.X_MB.p).norm();
  return moved < c.drift_position + c.drift_share * way &&
         base::Log(claim.X_NM.q).norm() < c.drift_angle + c.drift_angle_rate * time;
}

bool Mapper::Confirmed(const Keyframe& keyframe, const Claim& claim) {
  const LoopConfig& c = config_.loop;
  int agreeing = 1;
  for (const Claim& other : claims_) {
    if (other.part != claim.part || keyframe.id - other.loop.now > c.agree_within) continue;
    const double apart = (claim.X_NM * keyframe.X_MB.p - other.X_NM * keyframe.X_MB.p).norm();
    if (apart < c.agree_position && AngleBetween(claim.X_NM.q, other.X_NM.q) < c.agree_angle) ++agreeing;
  }
  claims_.push_back(claim);
  while (keyframe.id - claims_.front().loop.now > c.agree_within) claims_.pop_front();
  return agreeing >= c.agree;
}

std::vector<LandmarkMatch> Mapper::MatchAll(const Keyframe& keyframe, const Transform& X_MB,
                                            const std::vector<int>& landmarks, double radius) const {
  std::vector<base::Vec2> pixels;
  for (const PlacePoint& point : keyframe.view.points) pixels.push_back(point.pixel);
  const features::KeypointGrid grid(pixels, rig_.left.width, rig_.left.height);
  std::vector<int> unseen;
  for (const int l : landmarks) {
    if (!map_.landmarks[static_cast<std::size_t>(l)]) continue;
    const auto& sights = map_.landmark(l).sights;
    if (std::none_of(sights.begin(), sights.end(),
                     [&keyframe](const Landmark::Sight& s) { return s.keyframe == keyframe.id; }))
      unseen.push_back(l);
  }
  std::vector<LandmarkMatch> matches;
  for (const Among among : {Among::kFree, Among::kTaken}) {
    for (const LandmarkMatch& m : FindLandmarks(map_, keyframe, X_MB, unseen, grid, rig_.left, radius, config_, among))
      matches.push_back(m);
  }
  std::sort(matches.begin(), matches.end(), [](const LandmarkMatch& a, const LandmarkMatch& b) {
    return a.landmark != b.landmark ? a.landmark < b.landmark : a.distance < b.distance;
  });
  matches.erase(std::unique(matches.begin(), matches.end(),
                            [](const LandmarkMatch& a, const LandmarkMatch& b) { return a.landmark == b.landmark; }),
                matches.end());
  return matches;
}

/// The keyframe and those that see the same learn what the known place shows: the same landmark twice becomes one.
void Mapper::FuseAround(int id, int known) {
  std::vector<int> here{id};
  for (const Covisible& c : CovisibleWith(map_, id, kSharedThere)) {
    if (static_cast<int>(here.size()) <= kFusedAround) here.push_back(c.keyframe);
  }
  for (const int k : here) {
    const Keyframe& keyframe = map_.keyframe(k);
    for (const LandmarkMatch& m :
         MatchAll(keyframe, keyframe.X_MB, LandmarksAround(known, keyframe.X_MB), config_.search.near_radius)) {
      if (!map_.landmarks[static_cast<std::size_t>(m.landmark)]) continue;  // fused by now
      const Sight sight = SightOf(keyframe, m.feature, 0, rig_.left, config_);
      const auto r = ResidualOf(keyframe.X_MB, map_.eyes, sight, map_.landmark(m.landmark).p_M);
      if (!r || r->norm() > config_.adjust.gate) continue;
      const int shown = keyframe.landmarks[static_cast<std::size_t>(m.feature)];
      if (shown < 0) {
        AddSight(map_, m.landmark, k, m.feature);
        RefreshLandmark(map_, m.landmark);
      } else if (shown != m.landmark) {
        FuseLandmarks(map_, std::max(shown, m.landmark), std::min(shown, m.landmark));
      }
    }
  }
}

}  // namespace alula::stack::slam
