#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/time.h"
#include "stack/mapping/clearance_field.h"
#include "stack/planning/global_planner.h"
#include "stack/planning/trajectory.h"

namespace alula::stack::planning {

/// A gate to be flown through straight, along the x axis of its frame, from −before to +after.
struct Passage {
  int gate = 0;  // index into the mission's gates; names the leg that leads to it
  base::Transform X_OG;
  double half_opening = 0.6;  // m
  /// Not measured well enough to be entered: the route stops at a view point before it.
  bool closed = false;
  /// For a closed passage: where to look from, in order of preference; the first that can be reached is taken.
  std::vector<base::Vec3> views_O{};
};

/// A capsule that counts as known-free: the take-off column, the place where the vehicle is.
struct FreeZone {
  base::Vec3 a_O = base::Vec3::Zero();
  base::Vec3 b_O = base::Vec3::Zero();
  double radius = 0.0;  // m
};

struct RouteConfig {
  double clearance = 0.35;             // m, planned distance to anything occupied (hull 0.19 + map 0.05 + tracking 0.1)
  double flown_clearance = 0.29;       // m, of the smoothed curve
  double clearance_floor = 0.24;       // m, of relaxed starts and goals, and of the trajectory being flown
  double comfortable_clearance = 0.7;  // m; nearer than this, smoothing pushes the curve away where it can
  double known_free_radius = 0.25;     // m, ball that should have been seen free wherever the vehicle flies
  double known_free_hull = 0.19;       // m, ball of the hull's size; where less than that was seen free it creeps
  double known_free_floor = 0.06;      // m, ball that must have been: it stops before where even this is unknown
  double barely_seen_speed = 1.2;      // m/s between radius and hull (specks that stereo left out beside the path)
  double creep_speed = 0.6;     // m/s between hull and floor: it stops within 0.35 m, and stereo sees from 0.45 m on
  double passage_before = 1.2;  // m of straight flight before a gate …
  double passage_after = 1.2;   // … and after it: the frame leaves the view there
  double passage_exempt = 0.7;  // m to each side of the opening's plane where the gate's fit, not the map, decides
  double passage_speed = 2.0;   // m/s
  double point_spacing = 0.2;   // m between control points of the curve
  int smoothing_rounds = 150;   // of the elastic band
  TrajectoryLimits limits;
  GlobalPlannerConfig planner;
};
void Describe(base::Description& d, RouteConfig& c);

/// The way a leg went last time, by the gate that it leads to (−1: the target).
struct Leg {
  int gate = -1;
  std::vector<base::Vec3> path_O;
};

struct RouteRequest {
  std::shared_ptr<const mapping::ClearanceField> field;
  base::Time start_time;  // when the new trajectory takes over
  TrajectoryPoint start;  // what the present one does then
  /// Where the present trajectory goes next (some tenths of a second from `start` on): the new one begins by going the
  /// same way, or frequent replanning would keep the vehicle from ever turning.
  std::vector<base::Vec3> lead_O;
  std::vector<Passage> passages;       // in order; a closed one is the last
  std::optional<base::Vec3> target_O;  // after the passages
  std::vector<FreeZone> free_zones;
  std::vector<ClosedOpening> openings;  // of all gates: free legs do not cross them
  std::vector<Leg> previous;
  base::Vec3 bounds_low_O = base::Vec3::Zero();
  base::Vec3 bounds_high_O = base::Vec3::Zero();
  double ground_O = 0.0;
  // What recovery may relax.
  double clearance_scale = 1.0;
  double known_free_floor = -1.0;  // m; negative: the configured one
  double max_speed = -1.0;         // m/s; negative: the configured one
  bool limit_climb = true;
  std::uint64_t seed = 0;
  std::uint64_t number = 0;
};

enum class RouteEnd { kTarget, kClosedGate, kUnknownSpace, kNoWayOn };

struct RouteResult {
  bool ok = false;
  std::string reason;  // why not, why not farther, or what was relaxed
  std::optional<Trajectory> trajectory;
  RouteEnd end = RouteEnd::kTarget;  // what the trajectory stops at
  double flown_length = 0.0;         // m up to the stop
  double length = 0.0;               // m of the whole route
  std::vector<base::Vec3> path_O;    // the whole curve, for pictures
  std::vector<Leg> legs;
  int searches = 0;  // legs that needed the sampling planner
};

/// Waypoints → checked legs → elastic band → C² curve → trajectory that ends where known-free space does.
/// The curve really flown is checked against the map again; where smoothing cost too much clearance, the unsmoothed
/// polyline is tried, and where that fails too the result says so.
RouteResult PlanRoute(const RouteRequest& request, const RouteConfig& config, GlobalPlanner& planner);

/// First time in [from, trajectory.end()] at which the trajectory is nearer to something occupied than the floor
/// allows (relaxed near `from`, and inside the exempt part of the passages), if any.
std::optional<base::Time> FirstBlocked(const Trajectory& trajectory, base::Time from,
                                       const mapping::ClearanceField& field, const std::vector<Passage>& passages,
                                       const RouteConfig& config);

/// Whether a point lies where the gate's own fit decides: within ±exempt of the plane, inside the opening's prism.
bool InsideExempt(const Passage& passage, const base::Vec3& p_O, double exempt);

}  // namespace alula::stack::planning
