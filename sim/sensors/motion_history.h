#pragma once

#include <deque>

#include "sim/truth.h"

namespace alula::sim {

/// The vehicle's true motion over the last quarter of a second: as long as the longest exposure may be.
class MotionHistory {
 public:
  void Add(const TruthWindow& window);
  /// State at t; before the first window that is kept, or after the last one, the state there.
  vehicles::BodyState At(base::Time t) const;
  base::Time end() const { return windows_.empty() ? base::Time{} : windows_.back().end; }

 private:
  std::deque<TruthWindow> windows_;
};

}  // namespace alula::sim
