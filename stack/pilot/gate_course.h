#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "stack/interface/mission.h"
#include "stack/mapping/clearance_field.h"
#include "stack/perception/gate_finder.h"
#include "stack/pilot/flight_watch.h"
#include "stack/pilot/flown_trajectory.h"
#include "stack/pilot/gate_book.h"
#include "stack/pilot/gate_mission_config.h"
#include "stack/pilot/map_alignment.h"
#include "stack/pilot/mission_io.h"
#include "stack/pilot/recovery.h"
#include "stack/pilot/route_client.h"
#include "stack/pilot/route_request.h"

namespace alula::stack::pilot {

/// The course from the first gate to the target: counts the gates passed, watches the flight, asks for routes, and gets
/// the vehicle going again where it is stuck. It commands by changing the trajectory that is flown.
class GateCourse {
 public:
  GateCourse(const Mission& mission, const GateMissionConfig& config, const planning::RouteConfig& route,
             const MapAlignmentConfig& alignment, base::Duration plan_latency, std::uint64_t seed);

  /// A new map, and the gates as measured so far (one entry a gate). Also before the course begins.
  void OnMap(std::shared_ptr<const mapping::ClearanceField> field,
             const std::vector<std::optional<perception::GateObservation>>& gates);
  /// True when the route will be flown.
  bool OnRoute(const planning::RouteResult& result, FlownTrajectory& flown);

  /// Begins the course: `column` is the capsule flown through at take-off, from the pad upwards.
  void Begin(base::Time now, const planning::FreeZone& column, double ground_O);
  /// One tick. True when the vehicle hovers at the target.
  bool Update(const MissionInput& in, FlownTrajectory& flown, MissionOutput& out);

  const GateBook& book() const { return book_; }
  int next_gate() const { return progress_.next_gate; }

 private:
  /// What one tick works with. The set-point is that of the tick's begin, whatever the watchers do to the trajectory.
  struct Tick {
    const MissionInput& in;
    const planning::TrajectoryPoint setpoint;
    FlownTrajectory& flown;
    MissionOutput& out;
  };

  void WatchTracking(Tick& tick) const;
  void WatchGate(Tick& tick);
  void WatchPath(Tick& tick);
  bool Arrived(const Tick& tick) const;
  void HandleRest(Tick& tick);
  void LookAgain(Tick& tick);
  void Recover(Tick& tick);
  void Scan(Tick& tick, double half_angle) const;
  void AskForRoute(Tick& tick);
  planning::RouteRequest BuildRequest(base::Time now, const FlownTrajectory& flown) const;
  base::Vec3 TargetInO() const { return book_.X_MO().Inverse() * mission_.target; }

  Mission mission_;
  GateMissionConfig config_;
  planning::RouteConfig route_;
  base::Duration plan_latency_;
  std::uint64_t seed_;

  planning::FreeZone column_;
  double ground_O_ = 0.0;  // m

  GateBook book_;
  CourseProgress progress_;
  base::Vec3 last_p_O_ = base::Vec3::Zero();  // at the tick before
  std::shared_ptr<const mapping::ClearanceField> field_;
  bool new_map_ = false;  // since the tick before
  RouteClient client_;
  RestWatch rest_;
  Recovery recovery_;
  base::Time quiet_until_;  // about blocked paths
};

}  // namespace alula::stack::pilot
