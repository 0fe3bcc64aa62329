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
#include "stack/pilot/flown_trajectory.h"
#include "stack/pilot/gate_course.h"
#include "stack/pilot/gate_mission_config.h"
#include "stack/pilot/map_alignment.h"
#include "stack/pilot/mission_io.h"
#include "stack/planning/route_planner.h"

namespace alula::stack::pilot {

/// Take-off, scan, gates in order, target: the phases of the flight, and the set-points along its trajectory.
/// It computes nothing slow: routes are planned elsewhere, `plan_latency` after they were asked for.
class GateMission {
 public:
  GateMission(const Calibration& calibration, const Mission& mission, const GateMissionConfig& config,
              const planning::RouteConfig& route, const MapAlignmentConfig& alignment, base::Duration plan_latency,
              std::uint64_t seed);

  /// A new map, and the gates as measured so far (one entry a gate).
  void OnMap(std::shared_ptr<const mapping::ClearanceField> field,
             const std::vector<std::optional<perception::GateObservation>>& gates);
  void OnRoute(planning::RouteResult result);
  MissionOutput Update(const MissionInput& input);

  StackState state() const { return state_; }
  int next_gate() const { return course_.next_gate(); }
  /// Map frame ← odometry frame, as the measured gates suggest.
  const base::Transform& X_MO() const { return course_.book().X_MO(); }
  /// What is being flown, m, and the gates measured so far; for pictures.
  const std::vector<base::Vec3>& path_O() const { return path_O_; }
  std::vector<base::Transform> gates_O() const;
  /// Grows when path or gates change.
  std::uint64_t revision() const { return revision_; }

 private:
  enum class Phase { kInitialising, kArming, kClimb, kScan, kCourse, kArrived, kLost, kEnded };

  void Proceed(const MissionInput& in, MissionOutput& out);
  void WaitForOdometry(const MissionInput& in, MissionOutput& out);
  void Arming(const MissionInput& in, MissionOutput& out);
  void TakeOff(const MissionInput& in, MissionOutput& out);
  void Climb(base::Time now, const planning::TrajectoryPoint& here);
  void ClimbOnOrScan(base::Time now, MissionOutput& out);
  void BeginScan(base::Time now, MissionOutput& out);
  void BeginCourse(base::Time now, MissionOutput& out);
  bool CheckOdometry(const MissionInput& in, MissionOutput& out);
  void SendSetpoint(const MissionInput& in, MissionOutput& out);
  void Fail(base::Time now, const std::string& kind, const std::string& text, MissionOutput& out);
  void Send(base::Time now, decltype(Command::what) what, MissionOutput& out) const;

  Calibration calibration_;
  GateMissionConfig config_;
  planning::TrajectoryLimits limits_;
  double column_radius_;  // m, of the take-off column

  Phase phase_ = Phase::kInitialising;
  Phase phase_before_loss_ = Phase::kCourse;
  StackState state_ = StackState::kInitialising;
  base::Time next_arm_, next_setpoint_, lost_since_;
  base::Vec3 takeoff_O_ = base::Vec3::Zero();

  FlownTrajectory flown_;
  GateCourse course_;
  std::vector<base::Vec3> path_O_;
  std::uint64_t revision_ = 0;
};

}  // namespace alula::stack::pilot
