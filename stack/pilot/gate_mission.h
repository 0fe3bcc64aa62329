#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "stack/mapping/clearance_field.h"
#include "stack/perception/gate_finder.h"
#include "stack/pilot/map_alignment.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

struct GateMissionConfig {
  double takeoff_height = 1.2;   // m above the pad
  double takeoff_speed = 0.8;    // m/s
  double scan_half_angle = 1.3;  // rad to each side of the start heading
  double scan_rate = 1.2;        // rad/s
  double good_sigma = 0.08;      // m in the opening's plane: a gate measured this well may be entered
  double good_range = 3.3;       // m; it must have been seen from this near
  double coarse_sigma = 0.16;    // m, accepted after the first look in vain
  double freeze_distance = 1.1;  // m before the plane: the frame leaves the view, the fit is kept
  double view_distance = 2.4;    // m before a gate that is not measured well enough
  base::Duration look_time = base::Milliseconds(1500);      // at a view point before another is tried
  base::Duration stuck_time = base::Milliseconds(1500);     // at rest without progress before recovery
  base::Duration lost_time = base::Milliseconds(2500);      // without healthy odometry before landing
  base::Duration setpoint_period = base::Milliseconds(10);  // 100 Hz
  base::Duration command_lifetime = base::Milliseconds(500);
  double arrival_radius = 0.3;      // m, at the target
  double tracking_tolerance = 0.9;  // m between set-point and estimate before the mission starts over from a hover
  double creep_speed = 0.6;         // m/s where recovery flies on into space that was hardly seen
  /// Control experiment: take the gates from the mission's list, as if they had been measured there.
  bool trust_gate_list = false;
};
void Describe(base::Description& d, GateMissionConfig& c);

/// What the mission is told each tick.
struct MissionInput {
  base::Time now;
  bool initialised = false;  // the odometry runs
  bool healthy = false;      // … and may be trusted
  base::Transform X_OB;      // now
  base::Vec3 v_OB = base::Vec3::Zero();
  VehicleStatus status;
  bool status_known = false;
};

struct MissionOutput {
  std::vector<Command> commands;
  std::vector<StackEvent> events;
  /// A route to plan; the answer comes through OnRoute.
  std::optional<planning::RouteRequest> request;
};

/// Take-off, scan, gates in order, target: decides what is flown next, follows the trajectory, and recovers.
/// It computes nothing slow: routes are planned elsewhere, `plan_latency` after they were asked for.
class GateMission {
 public:
  GateMission(const Calibration& calibration, const Mission& mission, const GateMissionConfig& config,
              const planning::RouteConfig& route, const MapAlignmentConfig& alignment, base::Duration plan_latency,
              std::uint64_t seed);
  ~GateMission();

  /// A new map, and the gates as measured so far (one entry a gate).
  void OnMap(base::Time now, std::shared_ptr<const mapping::ClearanceField> field,
             const std::vector<std::optional<perception::GateObservation>>& gates);
  void OnRoute(base::Time now, planning::RouteResult result);
  MissionOutput Update(const MissionInput& input);

  StackState state() const;
  int next_gate() const;
  /// Map frame ← odometry frame, as the measured gates suggest.
  const base::Transform& X_MO() const;
  /// What is being flown, m, and the gates as used; for pictures.
  const std::vector<base::Vec3>& path_O() const;
  std::vector<base::Transform> gates_O() const;
  /// Grows when path or gates change.
  std::uint64_t revision() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::pilot
