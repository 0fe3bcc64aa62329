#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/describe.h"
#include "stack/slam/keyframe_database.h"

namespace alula::stack::slam {

/// How hypotheses live from one keyframe to the next.
struct LoopFilterConfig {
  double stay_new = 0.9;     // chance that a keyframe after one of a new place shows a new place too
  double stay_known = 0.9;   // chance that one after a known place shows it or a neighbour of it
  double break_even = 2.5;   // σ above the middle at which a score speaks neither for the place nor against it: places
                             // that are there lie 4–9 σ above, the best of 50 that are not 2–3.5
  double strongest = 100.0;  // no single keyframe changes the odds by more: with it a loop takes two or three
  double least_sigma = 0.01;  // of scores: a view of little, whose scores are all next to 0, is no evidence
  double accept = 0.6;  // a loop is one whose hypothesis, with its neighbours', has this probability: geometry has the
                        // last word and costs some ms
};

void Describe(base::Description& d, LoopFilterConfig& c);

/// Probability that the newest keyframe shows the place of keyframe `id`, its neighbours' included.
struct LoopHypothesis {
  KeyframeId id = 0;
  double probability = 0.0;
};

/// P3's discrete Bayesian filter over loops, p(S_t | I^t) = η p(I_t | S_t) Σ p(S_t | S_{t−1}) p(S_{t−1} | I^{t−1})
/// (P3, eq. 8; the terms as Angeli et al. 2008 and Labbé and Michaud 2013 have them): S_t is a keyframe, or "a new
/// place".
///   prediction   new → new stay_new, the rest to all keyframes alike;
///                known → itself and its neighbours stay_known in equal shares, the rest to new;
///   likelihood   of a keyframe against a new place: exp(z − break_even), cut at `strongest` and its inverse, z the
///   mean of
///                its own height above the middle, (s − μ)/σ, and of the greatest among its neighbours: that it is
///                there the best of a place says for all of it, where it is each says for itself.
/// μ and σ are the middle and the spread of the scores of all keyframes, of which loops are a few outliers: median
/// and 1.4826 × median deviation. (Labbé and Michaud weigh by (s − σ)/μ against 1 + μ/σ with mean and standard
/// deviation: there one true match among n keyframes raises σ as 1/√n, and the more keyframes there are the surer every
/// place is new.)
class LoopFilter {
 public:
  explicit LoopFilter(const LoopFilterConfig& config) : config_(config) {}

  /// A keyframe that loops may lead to from now on, usually one that has left the neighbourhood of the newest, and the
  /// keyframes that show the same as it. Neighbourhood is mutual.
  void Add(KeyframeId id, std::span<const KeyframeId> neighbours);
  void Remove(KeyframeId id);

  /// One step with all scores of a query; keyframes without one have 0, unknown ones are passed over.
  void Update(std::span<const PlaceCandidate> scores);

  /// The most probable keyframe with its neighbours, where that reaches `accept`.
  std::optional<LoopHypothesis> Loop() const;
  double new_place() const { return new_place_; }
  /// Of every keyframe alone, ascending in the id; they and new_place() sum to 1.
  std::vector<LoopHypothesis> Hypotheses() const;

 private:
  struct State {
    double probability = 0.0;
    std::vector<KeyframeId> neighbours;  // ascending; may name keyframes that are not there (yet)
  };
  std::map<KeyframeId, double> Predict(double& new_place) const;
  std::vector<KeyframeId> KnownNeighbours(const State& state) const;

  LoopFilterConfig config_;
  std::map<KeyframeId, State> states_;
  double new_place_ = 1.0;
};

}  // namespace alula::stack::slam
