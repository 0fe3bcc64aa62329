#include "stack/slam/keyframe_database.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "base/error.h"

namespace alula::stack::slam {
namespace {

bool Before(const PlaceCandidate& a, const PlaceCandidate& b) {
  return a.score != b.score ? a.score > b.score : a.id < b.id;
}

/// Where an id stands, or would stand, in the list by ids.
auto Place(auto& slots, KeyframeId id) {
  return std::lower_bound(slots.begin(), slots.end(), id, [](const auto& s, KeyframeId k) { return s.first < k; });
}

template <typename Index>
void AddPostings(const WordVector& words, std::uint32_t slot, Index& index) {
  if (!words.empty() && index.size() <= words.back().word) index.resize(words.back().word + 1);
  for (const WeightedWord& w : words) index[w.word].push_back({slot, w.weight});
}

template <typename Index>
void RemovePostings(const WordVector& words, std::uint32_t slot, Index& index) {
  for (const WeightedWord& w : words) std::erase_if(index[w.word], [slot](const auto& p) { return p.slot == slot; });
}

/// Adds share · Σ min(v_i, w_i) to the keyframes' scores.
template <typename Index>
void Accumulate(const WordVector& words, double share, const Index& index, std::vector<double>& scores) {
  for (const WeightedWord& w : words) {
    if (w.word >= index.size()) break;
    for (const auto& p : index[w.word]) scores[p.slot] += share * std::min(w.weight, p.weight);
  }
}

}  // namespace

std::optional<std::uint32_t> KeyframeDatabase::SlotOf(KeyframeId id) const {
  const auto at = Place(slot_of_, id);
  if (at == slot_of_.end() || at->first != id) return std::nullopt;
  return at->second;
}

const BagOfWords* KeyframeDatabase::Find(KeyframeId id) const {
  const auto slot = SlotOf(id);
  return slot ? &entries_[*slot].words : nullptr;
}

void KeyframeDatabase::Add(KeyframeId id, BagOfWords words) {
  if (SlotOf(id)) throw base::FaultError("keyframe_twice", "keyframe " + std::to_string(id) + " is known already");
  std::uint32_t slot = static_cast<std::uint32_t>(entries_.size());
  if (free_.empty()) {
    entries_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  slot_of_.insert(Place(slot_of_, id), {id, slot});
  AddPostings(words.points, slot, points_);
  AddPostings(words.lines, slot, lines_);
  entries_[slot] = {id, std::move(words)};
}

void KeyframeDatabase::Remove(KeyframeId id) {
  const auto at = Place(slot_of_, id);
  if (at == slot_of_.end() || at->first != id) return;
  const std::uint32_t slot = at->second;
  RemovePostings(entries_[slot].words.points, slot, points_);
  RemovePostings(entries_[slot].words.lines, slot, lines_);
  entries_[slot] = {};
  free_.push_back(slot);
  slot_of_.erase(at);
}

std::vector<PlaceCandidate> KeyframeDatabase::Query(const BagOfWords& view,
                                                    std::span<const KeyframeId> excluded) const {
  std::vector<PlaceCandidate> found;
  const int count = view.point_count + view.line_count;
  if (count == 0) return found;
  std::vector<double> scores(entries_.size(), 0.0);
  Accumulate(view.points, static_cast<double>(view.point_count) / count, points_, scores);
  Accumulate(view.lines, static_cast<double>(view.line_count) / count, lines_, scores);
  for (const KeyframeId id : excluded) {
    if (const auto slot = SlotOf(id)) scores[*slot] = 0.0;
  }
  for (const auto& [id, slot] : slot_of_) {
    if (scores[slot] > 0.0) found.push_back({id, scores[slot]});
  }
  std::sort(found.begin(), found.end(), Before);
  return found;
}

std::vector<PlaceCandidate> Normalised(std::vector<PlaceCandidate> candidates, double reference, double least) {
  if (reference < least) return {};
  for (PlaceCandidate& c : candidates) c.score /= reference;
  return candidates;
}

std::vector<PlaceCandidate> Grouped(const std::vector<PlaceCandidate>& candidates,
                                    const std::function<std::vector<KeyframeId>(KeyframeId)>& neighbours_of) {
  std::map<KeyframeId, double> score_of;
  for (const PlaceCandidate& c : candidates) score_of[c.id] = c.score;
  std::map<KeyframeId, double> best;  // the best of each group with the largest sum that it was the best of
  for (const PlaceCandidate& c : candidates) {
    PlaceCandidate top = c;
    double sum = c.score;
    for (const KeyframeId id : neighbours_of(c.id)) {
      const auto at = score_of.find(id);
      if (at == score_of.end() || id == c.id) continue;
      sum += at->second;
      if (at->second > top.score) top = {id, at->second};
    }
    best[top.id] = std::max(best[top.id], sum);
  }
  std::vector<PlaceCandidate> groups;
  for (const auto& [id, sum] : best) groups.push_back({id, sum});
  std::sort(groups.begin(), groups.end(), Before);
  return groups;
}

}  // namespace alula::stack::slam
