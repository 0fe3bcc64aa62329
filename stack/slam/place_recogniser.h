#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "stack/slam/keyframe_database.h"
#include "stack/slam/loop_config.h"
#include "stack/slam/loop_filter.h"
#include "stack/slam/map.h"
#include "stack/slam/vocabulary.h"

namespace alula::stack::slam {

/// A keyframe of the map that shows what another one shows.
struct KnownPlace {
  int keyframe = 0;
  base::Transform X_KB;  // body of the keyframe that looks, in the body of the known one
};

/// Says of each new keyframe whether its place was seen before, by what it looks like alone: words → candidates → the
/// hypothesis that lives over several keyframes (P3's filter) → geometry between the two views. After the way was lost
/// the most alike of the other parts are compared without a hypothesis (relocalisation: Mur-Artal et al. 2015). Where
/// the map believes to be does not enter; who asks must weigh it.
class PlaceRecogniser {
 public:
  PlaceRecogniser(const LoopConfig& config, std::shared_ptr<const Vocabulary> vocabulary);

  /// Looks for the place of keyframe `id`, the newest of the map, and remembers it. Keyframes that see the same
  /// landmarks, and the last ones of its own part, are no news. The same calls give the same answers.
  std::optional<KnownPlace> Look(const Map& map, int id);
  /// Keyframes of a map from before.
  void Remember(const Map& map);
  void Forget(int keyframe);

 private:
  bool IsNews(const Map& map, int candidate, int id, const std::vector<Covisible>& around) const;
  std::vector<int> ToLookAt(const Map& map, int id, const std::vector<PlaceCandidate>& candidates,
                            const std::vector<Covisible>& around) const;
  std::vector<KeyframeId> NeighboursOf(const Map& map, int id) const;

  LoopConfig config_;
  std::shared_ptr<const Vocabulary> vocabulary_;
  KeyframeDatabase database_;
  LoopFilter filter_;
  std::deque<int> recent_;  // keyframes that the filter does not know yet, oldest first
};

}  // namespace alula::stack::slam
