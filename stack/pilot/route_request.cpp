#include "stack/pilot/route_request.h"

#include <utility>

#include "stack/pilot/view_points.h"

namespace alula::stack::pilot {

using base::Vec3;
using planning::Passage;

namespace {

constexpr int kOpenAhead = 2;                                 // gates planned through ahead
constexpr int kLeadPoints = 6;                                // of the present trajectory that a new one follows …
constexpr base::Duration kLeadStep = base::Milliseconds(50);  // … this far apart
constexpr double kFlownRadius = 0.12;                         // m about the present trajectory that counts as free

Passage PassageOf(const GateBook& book, int gate) {
  return {.gate = gate,
          .X_OG = book.X_OG(gate),
          .half_opening = 0.5 * book.opening(gate),
          .closed = !book.Good(gate),
          .views_O = {}};
}

}  // namespace

PassagesAhead FindPassages(const GateBook& book, const CourseProgress& progress, double view_distance,
                           double ground_O) {
  PassagesAhead ahead;
  if (progress.exiting >= 0) ahead.passages.push_back(PassageOf(book, progress.exiting));
  int gate = progress.next_gate;
  for (; gate < book.size() && gate < progress.next_gate + kOpenAhead; ++gate) {
    Passage passage = PassageOf(book, gate);
    if (passage.closed) passage.views_O = ViewPoints(passage.X_OG, view_distance, progress.looks, ground_O);
    ahead.passages.push_back(std::move(passage));
    if (ahead.passages.back().closed) break;
  }
  ahead.to_target = gate >= book.size();
  return ahead;
}

std::vector<Vec3> LeadPoints(const planning::Trajectory& trajectory, base::Time start, double knot_period) {
  std::vector<Vec3> points;
  for (int i = 1; i <= kLeadPoints; ++i) {
    points.push_back(trajectory.Sample(start + base::Seconds(knot_period) + kLeadStep * i).p_O);
  }
  return points;
}

std::vector<planning::FreeZone> FlownZones(const planning::Trajectory& trajectory, base::Time start) {
  std::vector<planning::FreeZone> zones;
  const std::vector<Vec3> flown = trajectory.Points(start);
  for (std::size_t i = 1; i < flown.size(); ++i) zones.push_back({flown[i - 1], flown[i], kFlownRadius});
  return zones;
}

std::vector<planning::ClosedOpening> Openings(const GateBook& book) {
  std::vector<planning::ClosedOpening> openings;
  for (int i = 0; i < book.size(); ++i) openings.push_back({book.X_OG(i), 0.5 * book.opening(i)});
  return openings;
}

void Concede(const Concessions& concessions, planning::RouteRequest& request) {
  if (concessions.ignore_openings) request.openings.clear();
  request.clearance_scale = concessions.clearance_scale;
  request.known_free_floor = concessions.known_free_floor;
  request.max_speed = concessions.max_speed;
  request.limit_climb = concessions.limit_climb;
}

}  // namespace alula::stack::pilot
