#include "stack/slam/loop_filter.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::slam {
namespace {

void Insert(std::vector<KeyframeId>& sorted, KeyframeId id) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), id);
  if (at == sorted.end() || *at != id) sorted.insert(at, id);
}

/// Mean and standard deviation of scores above 0: keyframes that share nothing with the view do not belong to what it
/// is compared with.
struct Spread {
  double mean = 0.0, sigma = 0.0;
};
Spread SpreadOf(std::span<const PlaceCandidate> scores) {
  double sum = 0.0, squares = 0.0;
  for (const PlaceCandidate& c : scores) {
    sum += c.score;
    squares += c.score * c.score;
  }
  const double n = std::max<double>(1.0, static_cast<double>(scores.size()));
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n))};
}

}  // namespace

void Describe(base::Description& d, LoopFilterConfig& c) {
  d.Field("stay_new", c.stay_new, {.meaning = "chance that a new place is followed by one", .min = 0.01, .max = 0.999});
  d.Field("stay_known", c.stay_known,
          {.meaning = "chance that a known place is followed by it or a neighbour", .min = 0.01, .max = 0.999});
  d.Field("accept", c.accept,
          {.meaning = "probability of a place, with its neighbours, that makes a loop", .min = 0.1, .max = 1.0});
}

void LoopFilter::Add(KeyframeId id, std::span<const KeyframeId> neighbours) {
  State& state = states_[id];
  for (const KeyframeId other : neighbours) {
    if (other == id) continue;
    Insert(state.neighbours, other);
    if (const auto at = states_.find(other); at != states_.end()) Insert(at->second.neighbours, id);
  }
}

void LoopFilter::Remove(KeyframeId id) {
  const auto at = states_.find(id);
  if (at == states_.end()) return;
  new_place_ += at->second.probability;
  states_.erase(at);
}

std::vector<KeyframeId> LoopFilter::KnownNeighbours(const State& state) const {
  std::vector<KeyframeId> known;
  for (const KeyframeId id : state.neighbours) {
    if (states_.contains(id)) known.push_back(id);
  }
  return known;
}

std::map<KeyframeId, double> LoopFilter::Predict(double& new_place) const {
  std::map<KeyframeId, double> next;
  const double to_each = (1.0 - config_.stay_new) * new_place_ / static_cast<double>(states_.size());
  for (const auto& [id, state] : states_) next[id] = to_each;
  new_place = config_.stay_new * new_place_;
  for (const auto& [id, state] : states_) {
    if (state.probability <= 0.0) continue;
    const std::vector<KeyframeId> around = KnownNeighbours(state);
    const double share = config_.stay_known * state.probability / static_cast<double>(around.size() + 1);
    next[id] += share;
    for (const KeyframeId neighbour : around) next[neighbour] += share;
    new_place += (1.0 - config_.stay_known) * state.probability;
  }
  return next;
}

void LoopFilter::Update(std::span<const PlaceCandidate> scores) {
  if (states_.empty()) return;
  std::vector<PlaceCandidate> known;
  for (const PlaceCandidate& c : scores) {
    if (states_.contains(c.id)) known.push_back(c);
  }
  const Spread spread = SpreadOf(known);
  double new_place = 0.0;
  std::map<KeyframeId, double> next = Predict(new_place);
  if (spread.mean > 0.0) {
    // With one score, or all alike, nothing stands out: σ is kept from being nothing against μ.
    const double sigma = std::max(spread.sigma, 0.1 * spread.mean);
    for (const PlaceCandidate& c : known) {
      if (c.score >= spread.mean + sigma) next[c.id] *= (c.score - sigma) / spread.mean;
    }
    new_place *= 1.0 + spread.mean / sigma;
  }
  double sum = new_place;
  for (const auto& [id, p] : next) sum += p;
  for (auto& [id, state] : states_) state.probability = next[id] / sum;
  new_place_ = new_place / sum;
}

std::optional<LoopHypothesis> LoopFilter::Loop() const {
  LoopHypothesis best;
  double own = 0.0;
  for (const auto& [id, state] : states_) {
    if (state.probability > own) {
      own = state.probability;
      best = {id, state.probability};
      for (const KeyframeId n : KnownNeighbours(state)) best.probability += states_.at(n).probability;
    }
  }
  if (own <= 0.0 || best.probability < config_.accept) return std::nullopt;
  return best;
}

std::vector<LoopHypothesis> LoopFilter::Hypotheses() const {
  std::vector<LoopHypothesis> all;
  for (const auto& [id, state] : states_) all.push_back({id, state.probability});
  return all;
}

}  // namespace alula::stack::slam
