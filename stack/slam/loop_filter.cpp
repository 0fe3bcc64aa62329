#include "stack/slam/loop_filter.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::slam {
namespace {

void Insert(std::vector<KeyframeId>& sorted, KeyframeId id) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), id);
  if (at == sorted.end() || *at != id) sorted.insert(at, id);
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void Describe(base::Description& d, LoopFilterConfig& c) {
  d.Field("stay_new", c.stay_new, {.meaning = "chance that a new place is followed by one", .min = 0.01, .max = 0.999});
  d.Field("stay_known", c.stay_known,
          {.meaning = "chance that a known place is followed by it or a neighbour", .min = 0.01, .max = 0.999});
  d.Field("break_even", c.break_even,
          {.meaning = "spreads above the middle of the scores that say nothing", .min = 0, .max = 100});
  d.Field("strongest", c.strongest, {.meaning = "factor on the odds by one keyframe at most", .min = 1, .max = 1e6});
  d.Field("least_sigma", c.least_sigma, {.meaning = "spread of the scores at least", .min = 1e-6, .max = 1});
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
  std::map<KeyframeId, double> score_of;
  std::vector<double> values, deviations;
  for (const PlaceCandidate& c : scores) {
    if (!states_.contains(c.id)) continue;
    score_of[c.id] = c.score;
    values.push_back(c.score);
  }
  values.resize(states_.size(), 0.0);  // what shares no word with the view is unlike it
  const double middle = Median(values);
  for (const double v : values) deviations.push_back(std::abs(v - middle));
  const double sigma = std::max(1.4826 * Median(deviations), config_.least_sigma);

  const auto height = [&](KeyframeId id) {
    const auto score = score_of.find(id);
    return ((score == score_of.end() ? 0.0 : score->second) - middle) / sigma;
  };
  double new_place = 0.0;
  std::map<KeyframeId, double> next = Predict(new_place);
  double sum = new_place;
  for (auto& [id, p] : next) {
    const double own = height(id);
    double best = own;
    for (const KeyframeId neighbour : KnownNeighbours(states_.at(id))) best = std::max(best, height(neighbour));
    const double evidence = std::exp(0.5 * (own + best) - config_.break_even);
    sum += p *= std::clamp(evidence, 1.0 / config_.strongest, config_.strongest);
  }
  for (auto& [id, state] : states_) state.probability = next.at(id) / sum;
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
