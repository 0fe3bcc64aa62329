#include "stack/pilot/recovery.h"

namespace alula::stack::pilot {

namespace {

constexpr base::Duration kRelaxation = base::Milliseconds(3500);  // how long concessions hold
constexpr double kProgress = 0.7;                                 // m of flight after which recovery starts anew
constexpr int kLooks = 6;                                         // in vain, before the list is believed
constexpr double kLookAround = 1.0;                               // rad to each side
constexpr double kLookBehind = 3.2;                               // the same: a full turn
constexpr double kLookForGate = 0.6;                              // the same: the gate is about where the list has it

}  // namespace

WayOut WayOutFor(int attempt, bool unknown_ahead, double creep_speed) {
  WayOut way;
  way.forget_legs = attempt > 0;
  way.remedy = "looking around";
  switch (attempt % 4) {
    case 0:
      way.concessions.known_free_floor = 0.01;
      if (!unknown_ahead) way.concessions.clearance_scale = 0.85;
      way.concessions.max_speed = creep_speed;
      way.remedy = "going on slowly with less margin";
      break;
    case 1:
      way.scan_half_angle = kLookAround;
      break;
    case 2:
      way.scan_half_angle = kLookBehind;
      break;
    default:
      way.concessions.known_free_floor = 0.0;
      way.concessions.clearance_scale = 0.7;
      way.concessions.max_speed = creep_speed;
      way.concessions.ignore_openings = true;
      way.concessions.limit_climb = false;
      way.remedy = "creeping on with the least margin";
      break;
  }
  return way;
}

WayOut Recovery::Next(base::Time now, const base::Vec3& p_O, bool unknown_ahead, double creep_speed) {
  const WayOut way = WayOutFor(attempts_++, unknown_ahead, creep_speed);
  stuck_at_O_ = p_O;
  concessions_ = way.concessions;
  until_ = now + kRelaxation;
  return way;
}

void Recovery::NoteProgress(const base::Vec3& p_O) {
  if ((p_O - stuck_at_O_).norm() > kProgress) attempts_ = 0;
}

AfterLook AfterLookInVain(int look) {
  if (look >= kLooks) return {.believe_list = true};
  return {.scan_half_angle = look % 2 == 1 ? kLookForGate : 0.0};
}

}  // namespace alula::stack::pilot
