#pragma once

#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/pilot/gate_book.h"
#include "stack/pilot/recovery.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

// The parts of a RouteRequest, each from what it depends on.

/// How far the vehicle is along the course.
struct CourseProgress {
  int next_gate = 0;
  int exiting = -1;  // gate whose corridor is being left, −1: none
  int looks = 0;     // at the next gate, in vain
};

struct PassagesAhead {
  std::vector<planning::Passage> passages;
  bool to_target = false;  // after the last of them the course is over
};

/// The corridor being left, and the next gates up to the first that is not known well enough to be entered.
PassagesAhead FindPassages(const GateBook& book, const CourseProgress& progress, double view_distance, double ground_O);

/// Where the trajectory goes after a new one, with knots every `knot_period` (s), has taken over at `start`, m.
std::vector<base::Vec3> LeadPoints(const planning::Trajectory& trajectory, base::Time start, double knot_period);

/// What is being flown from `start` on: it was known to be free when it was planned; cells that flicker since do not
/// matter.
std::vector<planning::FreeZone> FlownZones(const planning::Trajectory& trajectory, base::Time start);

/// The openings of all gates.
std::vector<planning::ClosedOpening> Openings(const GateBook& book);

/// Writes what recovery concedes into a request that is complete otherwise.
void Concede(const Concessions& concessions, planning::RouteRequest& request);

}  // namespace alula::stack::pilot
