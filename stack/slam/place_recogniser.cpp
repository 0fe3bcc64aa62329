#include "stack/slam/place_recogniser.h"

#include <algorithm>
#include <utility>

#include "stack/slam/relative_pose.h"

namespace alula::stack::slam {

using base::Transform;

namespace {

constexpr int kNeighbourly = 20;  // landmarks that two keyframes share which show the same place

}  // namespace

PlaceRecogniser::PlaceRecogniser(const LoopConfig& config, std::shared_ptr<const Vocabulary> vocabulary)
    : config_(config), vocabulary_(std::move(vocabulary)), filter_(config.filter) {}

bool PlaceRecogniser::IsNews(const Map& map, int candidate, int id, const std::vector<Covisible>& around) const {
  if (map.keyframe(candidate).part != map.keyframe(id).part) return true;
  if (id - candidate < config_.recent) return false;
  return std::none_of(around.begin(), around.end(),
                      [candidate](const Covisible& c) { return c.keyframe == candidate; });
}

std::vector<KeyframeId> PlaceRecogniser::NeighboursOf(const Map& map, int id) const {
  std::vector<KeyframeId> neighbours;
  for (const Covisible& c : CovisibleWith(map, id, kNeighbourly))
    neighbours.push_back(static_cast<KeyframeId>(c.keyframe));
  if (const int previous = map.keyframe(id).previous; previous >= 0)
    neighbours.push_back(static_cast<KeyframeId>(previous));
  return neighbours;
}

std::optional<KnownPlace> PlaceRecogniser::Look(const Map& map, int id) {
  const std::vector<Covisible> around = CovisibleWith(map, id, 1);
  std::erase_if(recent_, [&](int old) {
    if (!map.keyframes[static_cast<std::size_t>(old)]) return true;
    if (!IsNews(map, old, id, around)) return false;
    filter_.Add(static_cast<KeyframeId>(old), NeighboursOf(map, old));
    return true;
  });
  const Keyframe& now = map.keyframe(id);
  BagOfWords words = vocabulary_->WordsOf(now.view);
  std::vector<KeyframeId> no_news(recent_.begin(), recent_.end());
  for (const Covisible& c : around) no_news.push_back(static_cast<KeyframeId>(c.keyframe));
  const std::vector<PlaceCandidate> candidates = database_.Query(words, no_news);
  filter_.Update(candidates);
  database_.Add(static_cast<KeyframeId>(id), std::move(words));
  recent_.push_back(id);

  for (const int candidate : ToLookAt(map, id, candidates, around)) {
    const Keyframe& then = map.keyframe(candidate);
    const RelativePose pose =
        EstimateRelativePose(then.view, now.view, config_.geometry, static_cast<std::uint64_t>(id));
    if (!pose.accepted) continue;
    const Transform& X_BL = map.eyes.X_BL;
    return KnownPlace{then.id, X_BL * pose.X_AB * X_BL.Inverse()};
  }
  return std::nullopt;
}

std::vector<int> PlaceRecogniser::ToLookAt(const Map& map, int id, const std::vector<PlaceCandidate>& candidates,
                                           const std::vector<Covisible>& around) const {
  std::vector<int> chosen;
  const auto choose = [&](const PlaceCandidate& c) {
    if (static_cast<int>(chosen.size()) < config_.looks) chosen.push_back(static_cast<int>(c.id));
  };
  const std::optional<LoopHypothesis> loop = filter_.Loop();
  if (loop && IsNews(map, static_cast<int>(loop->id), id, around)) {
    // The hypothesis names a place: of it, the views that are most alike.
    std::vector<KeyframeId> place = NeighboursOf(map, static_cast<int>(loop->id));
    place.push_back(loop->id);
    for (const PlaceCandidate& c : candidates) {
      if (std::find(place.begin(), place.end(), c.id) != place.end()) choose(c);
    }
  } else {
    // Who has lost the way is probably somewhere near: what is most alike in other parts is worth a look.
    const int part = map.keyframe(id).part;
    for (const PlaceCandidate& c : candidates) {
      if (map.keyframe(static_cast<int>(c.id)).part != part) choose(c);
    }
  }
  return chosen;
}

void PlaceRecogniser::Remember(const Map& map) {
  for (const auto& keyframe : map.keyframes) {
    if (!keyframe) continue;
    database_.Add(static_cast<KeyframeId>(keyframe->id), vocabulary_->WordsOf(keyframe->view));
    filter_.Add(static_cast<KeyframeId>(keyframe->id), NeighboursOf(map, keyframe->id));
  }
}

void PlaceRecogniser::Forget(int keyframe) {
  database_.Remove(static_cast<KeyframeId>(keyframe));
  filter_.Remove(static_cast<KeyframeId>(keyframe));
  std::erase(recent_, keyframe);
}

}  // namespace alula::stack::slam
