#pragma once

#include <string_view>

#include "base/frames.h"
#include "base/time.h"

namespace alula::stack::pilot {

/// What recovery concedes for a while.
struct Concessions {
  double clearance_scale = 1.0;
  double known_free_floor = -1.0;  // m; negative: the configured one
  double max_speed = -1.0;         // m/s; negative: the configured one
  bool ignore_openings = false;    // free legs may cross gates
  bool limit_climb = true;
};

/// One way out of a place where no route leads on.
struct WayOut {
  Concessions concessions{};
  double scan_half_angle = 0.0;  // rad to each side; 0: no turn
  bool forget_legs = false;      // another way may be better than the last one
  std::string_view remedy;       // for the event
};

/// The order of ways out, tried in turn and over again: less margin, a look around, a look behind, the least margin.
/// `attempt` counts from 0; `unknown_ahead`: the route ended where known-free space does, so obstacles need no
/// concession.
WayOut WayOutFor(int attempt, bool unknown_ahead, double creep_speed);

/// Goes through the ways out while the vehicle is stuck, and starts anew after progress. Concessions lapse by
/// themselves: what was conceded for one tight spot must not last into the next.
class Recovery {
 public:
  WayOut Next(base::Time now, const base::Vec3& p_O, bool unknown_ahead, double creep_speed);
  /// Where the vehicle is now: far enough from where it was last stuck, the order starts anew.
  void NoteProgress(const base::Vec3& p_O);
  Concessions InForce(base::Time now) const { return now < until_ ? concessions_ : Concessions{}; }

 private:
  int attempts_ = 0;
  base::Vec3 stuck_at_O_ = base::Vec3::Zero();
  Concessions concessions_;
  base::Time until_;
};

/// What follows the `look`-th look in vain at a gate (counted from 1).
struct AfterLook {
  bool believe_list = false;     // no look helped: a poor fit, or the list, has to do
  double scan_half_angle = 0.0;  // rad to each side; 0: no turn, only the view point changes
};
AfterLook AfterLookInVain(int look);

}  // namespace alula::stack::pilot
