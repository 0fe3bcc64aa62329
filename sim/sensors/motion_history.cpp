#include "sim/sensors/motion_history.h"

#include <algorithm>

#include "base/error.h"

namespace alula::sim {

void MotionHistory::Add(const TruthWindow& window) {
  constexpr base::Duration kMemory = base::Milliseconds(250);
  windows_.push_back(window);
  while (windows_.front().end + kMemory < window.end) windows_.pop_front();
}

vehicles::BodyState MotionHistory::At(base::Time t) const {
  if (windows_.empty()) throw base::FaultError("sensors", "a motion was asked for before there was any");
  const auto window = std::lower_bound(windows_.begin(), windows_.end(), t,
                                       [](const TruthWindow& w, base::Time time) { return w.end < time; });
  return window == windows_.end() ? windows_.back().at_end : window->At(t);
}

}  // namespace alula::sim
