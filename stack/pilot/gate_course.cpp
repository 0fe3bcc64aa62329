#include "stack/pilot/gate_course.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "stack/pilot/gate_crossing.h"

namespace alula::stack::pilot {

using base::Duration;
using base::Time;
using base::Transform;
using base::Vec3;
using planning::RouteEnd;

namespace {

constexpr Duration kTakeover = base::Milliseconds(20);        // between a plan's join and the instant it takes over
constexpr Duration kBlockedQuiet = base::Milliseconds(1500);  // between two reports of a blocked path
constexpr Duration kArrivalRest = base::Milliseconds(200);    // at rest at the target before it counts
constexpr double kBoundsReserve = 0.3;                        // m kept from the mission's bounds

}  // namespace

GateCourse::GateCourse(const Mission& mission, const GateMissionConfig& config, const planning::RouteConfig& route,
                       const MapAlignmentConfig& alignment, Duration plan_latency, std::uint64_t seed)
    : mission_(mission),
      config_(config),
      route_(route),
      plan_latency_(plan_latency),
      seed_(seed),
      book_(mission, config, alignment) {}

void GateCourse::OnMap(std::shared_ptr<const mapping::ClearanceField> field,
                       const std::vector<std::optional<perception::GateObservation>>& gates) {
  field_ = std::move(field);
  new_map_ = true;
  book_.Update(gates);
}

bool GateCourse::OnRoute(const planning::RouteResult& result, FlownTrajectory& flown) {
  if (!client_.Accept(flown.generation(), result)) return false;
  flown.Queue(result.trajectory.value());
  return true;
}

void GateCourse::Begin(Time now, const planning::FreeZone& column, double ground_O) {
  column_ = column;
  ground_O_ = ground_O;
  last_p_O_ = column.a_O;
  rest_.Restart(now);
}

bool GateCourse::Update(const MissionInput& in, FlownTrajectory& flown, MissionOutput& out) {
  Tick tick{in, flown.Sample(in.now), flown, out};
  WatchTracking(tick);
  WatchGate(tick);
  rest_.Update(in.now, tick.setpoint);
  recovery_.NoteProgress(tick.setpoint.p_O);
  WatchPath(tick);
  if (!flown.Turning(in.now)) {
    if (Arrived(tick)) return true;
    HandleRest(tick);
  }
  if (!flown.Turning(in.now)) AskForRoute(tick);  // handling the rest may have begun a turn
  new_map_ = false;
  return false;
}

void GateCourse::WatchTracking(Tick& tick) const {
  const double distance = (tick.setpoint.p_O - tick.in.X_OB.p).norm();
  if (distance < config_.tracking_tolerance) return;
  Say(tick.out, tick.in.now, "tracking_lost",
      fmt::format("{:.2f} m from the set-point: starting over from here", distance));
  tick.flown.Brake(tick.in.now, {.p_O = tick.in.X_OB.p, .v_O = tick.in.v_OB, .yaw = base::Yaw(tick.in.X_OB.q)});
}

/// Counts the next gate when its plane is crossed inside the opening, and keeps its fit when it leaves the view.
void GateCourse::WatchGate(Tick& tick) {
  const Vec3 p_O = tick.in.X_OB.p;
  const Vec3 before_O = std::exchange(last_p_O_, p_O);
  if (progress_.exiting >= 0 &&
      CorridorLeft(book_.X_OG(progress_.exiting).Inverse() * tick.setpoint.p_O, route_.passage_after)) {
    progress_.exiting = -1;
  }
  const int gate = progress_.next_gate;
  if (gate >= book_.size()) return;
  const Transform X_GO = book_.X_OG(gate).Inverse();
  const Vec3 p_G = X_GO * p_O;
  if (FrameLeavesView(p_G, config_.freeze_distance) && book_.Good(gate)) book_.Freeze(gate);
  switch (CrossingOf(X_GO * before_O, p_G, book_.opening(gate))) {
    case Crossing::kNone:
      return;
    case Crossing::kBeside:
      Say(tick.out, tick.in.now, "gate_missed",
          fmt::format("went by gate {} {:.2f} m off its middle", gate, OffAxis(p_G)));
      return;
    case Crossing::kThrough:
      Say(tick.out, tick.in.now, "gate_passed",
          fmt::format("gate {} passed {:.2f} m off its measured middle", gate, p_G.tail<2>().norm()));
      progress_ = {.next_gate = gate + 1, .exiting = gate, .looks = 0};
      return;
  }
}

/// Brakes when the newest map shows something on the trajectory that a new route would come too late for.
void GateCourse::WatchPath(Tick& tick) {
  if (!new_map_ || !field_) return;
  const Time now = tick.in.now;
  if (!MustBrake(tick.flown.current(), now, tick.setpoint, *field_, client_.passages(), route_)) return;
  if (now >= quiet_until_) Say(tick.out, now, "path_blocked", "the map shows an obstacle on the path: braking");
  quiet_until_ = now + kBlockedQuiet;
  tick.flown.Brake(now, tick.setpoint);
}

bool GateCourse::Arrived(const Tick& tick) const {
  if (progress_.next_gate < book_.size() || !client_.last().to_target || rest_.Rest(tick.in.now) < kArrivalRest) {
    return false;
  }
  const Vec3 target_O = TargetInO();
  const bool away = (tick.setpoint.p_O - target_O).norm() > config_.arrival_radius ||
                    (tick.in.X_OB.p - target_O).norm() > config_.arrival_radius;
  return !away;
}

/// At rest for too long: look again, from elsewhere, or concede something. Never silently.
void GateCourse::HandleRest(Tick& tick) {
  if (!field_ || !client_.asked()) return;
  const Duration rest = rest_.Rest(tick.in.now);
  if (client_.last().ok && client_.last().end == RouteEnd::kClosedGate) {
    if (rest > config_.look_time) LookAgain(tick);
  } else if (rest > config_.stuck_time) {
    Recover(tick);
  }
}

void GateCourse::LookAgain(Tick& tick) {
  const Time now = tick.in.now;
  const int gate = progress_.next_gate;
  const int look = ++progress_.looks;
  rest_.Restart(now);
  const auto& fit = book_.Fit(gate);
  const std::string seen =
      fit ? fmt::format("measured to {:.2f} m from {:.1f} m", fit->position_sigma, fit->nearest) : "not seen";
  Say(tick.out, now, "gate_not_seen", fmt::format("gate {} is {} after look {}", gate, seen, look));
  book_.AcceptCoarse(gate);
  const AfterLook after = AfterLookInVain(look);
  if (after.believe_list) {
    book_.TrustList(gate);
    Say(tick.out, now, "gate_from_list",
        fmt::format("gate {} is taken from {}", gate, fit ? "a poor fit" : "the list"));
  }
  if (after.scan_half_angle > 0.0) Scan(tick, after.scan_half_angle);
}

void GateCourse::Recover(Tick& tick) {
  const Time now = tick.in.now;
  rest_.Restart(now);
  const RouteAnswer& last = client_.last();
  const bool unknown = last.ok && last.end == RouteEnd::kUnknownSpace;
  const std::string why = last.ok ? (unknown ? "known-free space ends here" : "the route ends here") : last.reason;
  const WayOut way = recovery_.Next(now, tick.setpoint.p_O, unknown, config_.creep_speed);
  if (way.scan_half_angle > 0.0) Scan(tick, way.scan_half_angle);
  if (way.forget_legs) client_.ForgetLegs();
  Say(tick.out, now, unknown ? "unknown_ahead" : "no_route", fmt::format("{}: {}", why, way.remedy));
}

void GateCourse::Scan(Tick& tick, double half_angle) const {
  const double yaw = tick.setpoint.yaw;
  tick.flown.Turn(tick.in.now, {yaw + half_angle, yaw - half_angle, yaw}, config_.scan_rate);
}

void GateCourse::AskForRoute(Tick& tick) {
  if (!field_ || tick.flown.waiting() || !client_.Due(tick.in.now, new_map_)) return;
  planning::RouteRequest request = BuildRequest(tick.in.now, tick.flown);
  client_.Ask(tick.in.now, tick.flown.generation(), request);
  tick.out.request = std::move(request);
}

planning::RouteRequest GateCourse::BuildRequest(Time now, const FlownTrajectory& flown) const {
  planning::RouteRequest request;
  request.field = field_;
  request.start_time = now + plan_latency_ + kTakeover;
  request.start = flown.Sample(request.start_time);
  request.lead_O = LeadPoints(flown.current(), request.start_time, route_.limits.knot_period);
  PassagesAhead ahead = FindPassages(book_, progress_, config_.view_distance, ground_O_);
  request.passages = std::move(ahead.passages);
  if (ahead.to_target) request.target_O = TargetInO();
  request.free_zones = FlownZones(flown.current(), request.start_time);
  request.free_zones.insert(request.free_zones.begin(), column_);
  request.openings = Openings(book_);
  request.previous = client_.legs();
  request.bounds_low_O = mission_.bounds_low + Vec3::Constant(kBoundsReserve);
  request.bounds_high_O = mission_.bounds_high - Vec3::Constant(kBoundsReserve);
  request.ground_O = ground_O_;
  request.seed = seed_;
  Concede(recovery_.InForce(now), request);
  return request;
}

}  // namespace alula::stack::pilot
