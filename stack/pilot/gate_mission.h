#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "stack/mapping/clearance_field.h"
#include "stack/perception/gate_finder.h"
#include "stack/pilot/gate_mission_config.h"
#include "stack/pilot/map_alignment.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

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
  /// What is being flown, m, and the gates measured so far; for pictures.
  const std::vector<base::Vec3>& path_O() const;
  std::vector<base::Transform> gates_O() const;
  /// Grows when path or gates change.
  std::uint64_t revision() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::pilot
