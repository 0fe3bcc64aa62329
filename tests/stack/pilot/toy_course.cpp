#include "tests/stack/pilot/toy_course.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "stack/planning/global_planner.h"

namespace alula::tests {

using base::Milliseconds;
using base::Time;
using base::Transform;
using base::Vec3;
using namespace stack;  // NOLINT: the toy speaks of little else

namespace {

constexpr double kSeen = 4.5;                              // m, range of the toy camera
constexpr base::Duration kMapLatency = Milliseconds(130);  // odometry, depth and map
constexpr base::Duration kPlanLatency = Milliseconds(100);

GateHint Gate(const char* name, double x, double y, double z, double yaw, double opening) {
  return {name, {base::FromYaw(yaw), {x, y, z}}, opening};
}

/// Second-order follower of set-points.
struct Vehicle {
  Vec3 p;
  Vec3 v = Vec3::Zero();
  double yaw = 0.0;
  PositionSetpoint setpoint{};

  void Step(double dt) {
    const Vec3 a = setpoint.a_OB + 36.0 * (setpoint.p_OB - p) + 12.0 * (setpoint.v_OB - v);
    v += a * dt;
    p += v * dt;
    yaw += std::clamp(8.0 * base::WrapAngle(setpoint.yaw - yaw), -2.0, 2.0) * dt;
  }
  Transform X_OB() const { return {base::FromYaw(yaw), p}; }
};

std::optional<perception::GateObservation> Observe(const GateHint& gate, const Transform& X_OB) {
  const Vec3 p_B = X_OB.Inverse() * gate.X_WG.p;
  if (p_B.x() < 0.8 || p_B.norm() > kSeen + 0.5) return std::nullopt;
  if (std::abs(std::atan2(p_B.y(), p_B.x())) > 0.5 || std::abs(p_B.z() / p_B.x()) > 0.4) return std::nullopt;
  perception::GateObservation fit;
  fit.X_OG = gate.X_WG;
  fit.opening = gate.opening;
  fit.score = 1.0;
  fit.position_sigma = 0.015 * p_B.norm();
  fit.nearest = p_B.norm();
  return fit;
}

}  // namespace

ToyCourse ToyCourse::Courtyard() {
  ToyCourse course;
  course.truth = {Gate("one", -7.0, -4.5, 1.5, 0.0, 1.5), Gate("two", -0.5, -6.0, 2.0, -0.2, 1.4),
                  Gate("three", 7.5, -4.0, 1.4, 0.9, 1.3), Gate("four", 8.0, 3.5, 2.1, 2.2, 1.4),
                  Gate("five", 1.0, 6.0, 1.6, 3.1, 1.2)};
  course.boxes = {{base::Quat::Identity(), {-3.5, -5.0, 1.4}}, {base::Quat::Identity(), {4.6, 5.0, 1.8}}};
  Mission& mission = course.mission;
  mission.X_WB_start = {base::FromYaw(0.0), {-12.0, -4.0, 0.12}};
  mission.takeoff_column_radius = 0.8;
  mission.gates = course.truth;
  mission.target = Vec3(-5, 4.5, 1.5);
  mission.bounds_low = Vec3(-15, -10, 0);
  mission.bounds_high = Vec3(15, 10, 4);
  return course;
}

int ToyResult::Count(const std::string& kind) const {
  return static_cast<int>(
      std::count_if(events.begin(), events.end(), [&](const StackEvent& event) { return event.kind == kind; }));
}

std::string ToyResult::Log() const {
  std::ostringstream out;
  for (const StackEvent& event : events) out << event.time.Seconds() << " " << event.kind << ": " << event.text << "\n";
  out << "took " << duration << " s for " << length << " m, clearance " << smallest_clearance << " m, offsets";
  for (const double offset : gate_offset) out << " " << offset;
  return out.str();
}

ToyResult Fly(const ToyCourse& course, std::uint64_t seed) {
  SyntheticMap map(course.mission.bounds_low - Vec3(0.3, 0.3, 0.3), course.mission.bounds_high + Vec3(0.3, 0.3, 0),
                   0.1);
  for (const GateHint& gate : course.truth) map.AddGate(gate.X_WG, gate.opening);
  for (const Transform& box : course.boxes) map.AddBox(box, Vec3(0.4, 0.4, 0.4));
  const Vec3 start = course.mission.X_WB_start.p;
  map.RevealBox(start - Vec3(0.8, 0.8, 0.2), start + Vec3(0.8, 0.8, 1.8));

  Calibration calibration;
  calibration.standing_height = start.z();
  pilot::GateMission mission(calibration, course.mission, course.config, course.route, {}, kPlanLatency, seed);
  const auto planner = planning::MakeInformedRrtStarPlanner(course.route.planner);
  Vehicle vehicle{.p = start, .yaw = base::Yaw(course.mission.X_WB_start.q)};
  vehicle.setpoint.p_OB = start;
  VehicleStatus status{.ready_to_arm = true};
  std::vector<std::optional<perception::GateObservation>> gates(course.truth.size());

  struct PendingMap {
    Time due;
    std::shared_ptr<const mapping::ClearanceField> field;
    std::vector<std::optional<perception::GateObservation>> gates;
  };
  std::optional<PendingMap> pending_map;
  std::optional<std::pair<Time, planning::RouteResult>> pending_route;
  ToyResult result;
  result.gate_offset.assign(course.truth.size(), -1.0);
  std::size_t next = 0;
  double course_begin = -1.0;
  std::shared_ptr<const mapping::ClearanceField> last_field;

  for (Time now; now.Seconds() < course.time_limit; now += Milliseconds(5)) {
    if (pending_map && pending_map->due <= now) {
      mission.OnMap(pending_map->field, pending_map->gates);
      last_field = pending_map->field;
      pending_map.reset();
    }
    if (pending_route && pending_route->first <= now) {
      mission.OnRoute(std::move(pending_route->second));
      pending_route.reset();
    }
    if (now.ns % 200'000'000 == 0) {
      map.Look(vehicle.X_OB(), kSeen);
      for (std::size_t i = 0; i < gates.size() && !course.blind_to_gates; ++i) {
        const auto fit = Observe(course.truth[i], vehicle.X_OB());
        if (fit && (!gates[i] || fit->position_sigma < gates[i]->position_sigma)) gates[i] = fit;
      }
      pending_map = PendingMap{now + kMapLatency, map.Snapshot(), gates};
    }
    pilot::MissionInput input;
    input.now = now;
    input.initialised = true;
    const double since_loss = now.Seconds() - course.lose_odometry_at;
    input.healthy = course.lose_odometry_at < 0.0 || since_loss < 0.0 || since_loss > course.lose_for;
    input.X_OB = vehicle.X_OB();
    input.v_OB = vehicle.v;
    input.status = status;
    input.status_known = true;
    pilot::MissionOutput output = mission.Update(input);
    for (const Command& command : output.commands) {
      if (std::holds_alternative<Arm>(command.what)) status.armed = true;
      if (std::holds_alternative<Hold>(command.what)) {
        vehicle.setpoint = {vehicle.p, Vec3::Zero(), Vec3::Zero(), vehicle.yaw, 0.0};
      }
      if (const auto* setpoint = std::get_if<PositionSetpoint>(&command.what)) vehicle.setpoint = *setpoint;
    }
    for (const StackEvent& event : output.events) {
      result.events.push_back(event);
      if (event.kind == "course") course_begin = now.Seconds();
    }
    if (output.request) {
      pending_route = {now + kPlanLatency, planning::PlanRoute(*output.request, course.route, *planner)};
    }
    const Vec3 before = vehicle.p;
    vehicle.Step(0.005);
    if (next < course.truth.size()) {
      const Vec3 a = course.truth[next].X_WG.Inverse() * before;
      const Vec3 b = course.truth[next].X_WG.Inverse() * vehicle.p;
      const double off = std::max(std::abs(b.y()), std::abs(b.z()));
      if (a.x() < 0.0 && b.x() >= 0.0 && off < 1.5) result.gate_offset[next++] = off;
    }
    if (course_begin >= 0.0) {
      result.length += (vehicle.p - before).norm();
      result.duration = now.Seconds() - course_begin;
      if (last_field && last_field->State(vehicle.p) == mapping::CellState::kUnknown) result.unknown_entered = true;
    }
    if (now.ns % 20'000'000 == 0) {
      result.smallest_clearance = std::min(result.smallest_clearance, map.TrueDistance(vehicle.p, 0.8));
    }
    result.state = mission.state();
    if (result.state == StackState::kDone || result.state == StackState::kFailed) break;
  }
  result.end_O = vehicle.p;
  return result;
}

}  // namespace alula::tests
