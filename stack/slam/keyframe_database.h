#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "stack/slam/vocabulary.h"

namespace alula::stack::slam {

using KeyframeId = std::uint64_t;

/// A keyframe that a view resembles.
struct PlaceCandidate {
  KeyframeId id = 0;
  double score = 0.0;  // likeness in [0, 1]
};

/// All keyframes by their words: an inverted index over points and over lines, so that a query touches only keyframes
/// that share a word.
class KeyframeDatabase {
 public:
  /// Throws base::FaultError where the id is there already.
  void Add(KeyframeId id, BagOfWords words);
  /// Nothing happens where the id is not there.
  void Remove(KeyframeId id);
  std::size_t size() const { return entries_.size() - free_.size(); }
  /// Null where the id is not there.
  const BagOfWords* Find(KeyframeId id) const;

  /// Keyframes that share words with the view but for `excluded` (its neighbours in time and covisibility), the most
  /// alike first, of equal ones the smaller id. Scores are those of Likeness().
  std::vector<PlaceCandidate> Query(const BagOfWords& view, std::span<const KeyframeId> excluded) const;

 private:
  struct Entry {
    KeyframeId id = 0;
    BagOfWords words;
  };
  struct Posting {
    std::uint32_t slot = 0;
    float weight = 0.0F;
  };
  using Index = std::vector<std::vector<Posting>>;  // by word

  std::optional<std::uint32_t> SlotOf(KeyframeId id) const;

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;                            // slots without a keyframe
  std::vector<std::pair<KeyframeId, std::uint32_t>> slot_of_;  // ascending in the id
  Index points_, lines_;
};

/// Divides scores by `reference`, the likeness of the view to its own neighbour in time: what the best of this place
/// can be expected to reach (Gálvez-López and Tardós 2012, eq. 3). Where even that is below `least`, the view says too
/// little: none is left.
std::vector<PlaceCandidate> Normalised(std::vector<PlaceCandidate> candidates, double reference, double least = 0.02);

/// One place seen in several keyframes counts once, with their common weight: each candidate's score and those of its
/// neighbours are summed, and of the candidates whose sums contain one another the one with the best score of its own
/// stays with the largest sum (groups as islands: Gálvez-López and Tardós 2012; by covisibility: Mur-Artal et al.
/// 2015). `neighbours_of` says which keyframes show the same as one. Largest sum first.
std::vector<PlaceCandidate> Grouped(const std::vector<PlaceCandidate>& candidates,
                                    const std::function<std::vector<KeyframeId>(KeyframeId)>& neighbours_of);

}  // namespace alula::stack::slam
