#include "stack/pilot/gate_mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stack/pilot/gate_book.h"
#include "stack/pilot/view_points.h"

namespace alula::stack::pilot {

using base::Duration;
using base::Time;
using base::Transform;
using base::Vec3;
using planning::Passage;
using planning::RouteEnd;
using planning::Trajectory;
using planning::TrajectoryPoint;

namespace {

constexpr Duration kArmPeriod = base::Milliseconds(500);
constexpr Duration kTakeover = base::Milliseconds(20);        // between a plan's join and the instant it takes over
constexpr Duration kIdleReplan = base::Milliseconds(400);     // without a new map a route is asked for this often
constexpr Duration kRelaxation = base::Milliseconds(3500);    // how long recovery's concessions hold
constexpr Duration kBlockedQuiet = base::Milliseconds(1500);  // between two reports of a blocked path
constexpr double kRestRadius = 0.25;                          // m within which it counts as at rest
constexpr double kProgress = 0.7;                             // m of flight after which recovery starts anew
constexpr int kOpenAhead = 2;                                 // gates planned through ahead
constexpr int kLooks = 6;                                     // in vain, before the list is believed
constexpr double kBoundsReserve = 0.3;                        // m kept from the mission's bounds
constexpr int kLeadPoints = 6;                                // of the present trajectory that a new one follows …
constexpr Duration kLeadStep = base::Milliseconds(50);        // … this far apart
constexpr double kFlownRadius = 0.12;   // m about the present trajectory that counts as known-free
constexpr double kReactionTime = 0.45;  // s that a new route needs: map's turn and plan

}  // namespace

/// What recovery concedes for a while.
struct Concessions {
  double clearance_scale = 1.0;
  double known_free_floor = -1.0;
  double max_speed = -1.0;
  bool ignore_openings = false;
  bool limit_climb = true;
};

class GateMission::Impl {
 public:
  Impl(const Calibration& calibration, const Mission& mission, const GateMissionConfig& config,
       const planning::RouteConfig& route, const MapAlignmentConfig& alignment, Duration plan_latency,
       std::uint64_t seed)
      : calibration_(calibration),
        mission_(mission),
        config_(config),
        route_(route),
        plan_latency_(plan_latency),
        seed_(seed),
        book_(mission, config, alignment) {}

  void OnMap(Time, std::shared_ptr<const mapping::ClearanceField> field,
             const std::vector<std::optional<perception::GateObservation>>& gates) {
    field_ = std::move(field);
    new_map_ = true;
    book_.Update(gates);
    ++revision_;
  }

  void OnRoute(Time, planning::RouteResult result) {
    in_flight_ = false;
    if (asked_generation_ != generation_) return;  // the vehicle has braked or turned since: out of date
    last_ok_ = result.ok;
    last_reason_ = result.reason;
    if (!result.ok) return;
    last_end_ = result.end;
    last_had_target_ = asked_target_;
    next_ = std::move(result.trajectory);
    legs_ = std::move(result.legs);
    path_O_ = std::move(result.path_O);
    ++revision_;
  }

  MissionOutput Update(const MissionInput& input) {
    MissionOutput output;
    out_ = &output;
    in_ = &input;
    if (next_ && input.now >= next_->start()) {
      trajectory_ = std::move(next_);
      next_.reset();
    }
    Proceed();
    SendSetpoint();
    out_ = nullptr;
    in_ = nullptr;
    return output;
  }

  StackState state() const { return state_; }
  int next_gate() const { return next_gate_; }
  const Transform& X_MO() const { return book_.X_MO(); }
  const std::vector<Vec3>& path_O() const { return path_O_; }
  std::uint64_t revision() const { return revision_; }
  std::vector<Transform> gates_O() const {
    std::vector<Transform> gates;
    for (int i = 0; i < book_.size(); ++i) {
      if (book_.Measured(i)) gates.push_back(book_.X_OG(i));
    }
    return gates;
  }

 private:
  enum class Phase { kInitialising, kArming, kClimb, kScan, kCourse, kArrived, kLost, kEnded };

  Time now() const { return in_->now; }

  void Proceed() {
    if (phase_ != Phase::kInitialising && phase_ != Phase::kArming && phase_ != Phase::kEnded) {
      if (!in_->status.armed) {
        Fail("disarmed", "the autopilot disarmed in flight");
        return;
      }
      if (!CheckOdometry()) return;
    }
    switch (phase_) {
      case Phase::kInitialising:
        if (!in_->initialised || !in_->healthy || !in_->status_known || !in_->status.ready_to_arm) return;
        state_ = StackState::kReady;
        phase_ = Phase::kArming;
        Say("ready", "odometry runs and the autopilot is ready: arming");
        return;
      case Phase::kArming:
        Arming();
        return;
      case Phase::kClimb:
        if (now() >= trajectory_->end() + base::Milliseconds(200)) BeginScan();
        return;
      case Phase::kScan:
        if (now() < trajectory_->yaw_end()) return;
        phase_ = Phase::kCourse;
        rest_since_ = now();
        Say("course", fmt::format("{} gates ahead", book_.size()));
        return;
      case Phase::kCourse:
        Course();
        return;
      case Phase::kArrived:
      case Phase::kLost:
      case Phase::kEnded:
        return;
    }
  }

  void Arming() {
    if (!in_->status.armed) {
      if (now() < next_arm_) return;
      next_arm_ = now() + kArmPeriod;
      Send(Arm{});
      return;
    }
    phase_ = Phase::kClimb;
    state_ = StackState::kFlying;
    ground_O_ = in_->X_OB.p.z() - calibration_.standing_height;
    const TrajectoryPoint here{.p_O = in_->X_OB.p, .yaw = base::Yaw(in_->X_OB.q)};
    planning::TrajectoryLimits limits = route_.limits;
    limits.max_climb_speed = config_.takeoff_speed;
    limits.max_acceleration = std::min(limits.max_acceleration, 1.5);
    const planning::Curve up({here.p_O, here.p_O + Vec3(0, 0, config_.takeoff_height)});
    trajectory_ = Trajectory::Along(now(), here, up, {}, limits);
    takeoff_O_ = here.p_O;
    last_p_O_ = here.p_O;
    path_O_ = {up.Position(0), up.Position(up.length())};
    ++revision_;
    Say("take_off", fmt::format("climbing {:.1f} m in the trusted column", config_.takeoff_height));
  }

  void BeginScan() {
    phase_ = Phase::kScan;
    const TrajectoryPoint here = trajectory_->Sample(now());
    double towards = 0.0;
    if (book_.size() > 0) {
      const Vec3 d = book_.X_OG(0).p - here.p_O;
      towards = base::WrapAngle(std::atan2(d.y(), d.x()) - here.yaw);
    }
    const double side = towards >= 0.0 ? 1.0 : -1.0;
    const double far = std::max(config_.scan_half_angle, std::abs(towards) + 0.4);
    TurnThrough({here.yaw - side * config_.scan_half_angle, here.yaw + side * far, here.yaw + towards});
    Say("scan", "looking around before the course");
  }

  void TurnThrough(const std::vector<double>& headings) {
    const TrajectoryPoint here = trajectory_->Sample(now());
    trajectory_ = Trajectory::Turn(now(), here.p_O, here.yaw, headings, config_.scan_rate, route_.limits);
    next_.reset();
    ++generation_;
  }

  /// False while nothing but waiting, or landing, is left to do.
  bool CheckOdometry() {
    if (in_->healthy) {
      if (phase_ == Phase::kLost) {
        phase_ = phase_before_loss_;
        Say("odometry_back", "the odometry is healthy again: starting over from a hover");
        BrakeFrom({.p_O = in_->X_OB.p, .v_O = in_->v_OB, .yaw = base::Yaw(in_->X_OB.q)});
      }
      return true;
    }
    if (phase_ != Phase::kLost) {
      phase_before_loss_ = phase_ == Phase::kClimb || phase_ == Phase::kScan ? Phase::kScan : phase_;
      phase_ = Phase::kLost;
      lost_since_ = now();
      Say("odometry_lost", "the odometry is not healthy: holding");
      Send(Hold{});
    } else if (now() - lost_since_ > config_.lost_time) {
      Fail("landing", "the odometry did not recover: landing here");
    } else if (now() >= next_setpoint_) {
      next_setpoint_ = now() + config_.setpoint_period;
      Send(Hold{});
    }
    return false;
  }

  void Course() {
    const TrajectoryPoint setpoint = trajectory_->Sample(now());
    WatchTracking(setpoint);
    WatchGate(setpoint);
    WatchRest(setpoint);
    WatchPath(setpoint);
    if (turning_ && now() >= trajectory_->yaw_end()) turning_ = false;
    if (!turning_ && Arrived(setpoint)) return;
    if (!turning_) HandleRest(setpoint);
    if (!turning_) AskForRoute();
    new_map_ = false;
  }

  void WatchTracking(const TrajectoryPoint& setpoint) {
    const double distance = (setpoint.p_O - in_->X_OB.p).norm();
    if (distance < config_.tracking_tolerance) return;
    Say("tracking_lost", fmt::format("{:.2f} m from the set-point: starting over from here", distance));
    BrakeFrom({.p_O = in_->X_OB.p, .v_O = in_->v_OB, .yaw = base::Yaw(in_->X_OB.q)});
  }

  /// Counts the next gate when its plane is crossed inside the opening, and keeps its fit when it leaves the view.
  void WatchGate(const TrajectoryPoint& setpoint) {
    const Vec3 p_O = in_->X_OB.p;
    const Vec3 before_O = std::exchange(last_p_O_, p_O);
    if (exiting_ >= 0) {
      const Vec3 p_G = book_.X_OG(exiting_).Inverse() * setpoint.p_O;
      if (p_G.x() > route_.passage_after - 0.15 || p_G.norm() > 3.0) exiting_ = -1;
    }
    if (next_gate_ >= book_.size()) return;
    const Transform X_GO = book_.X_OG(next_gate_).Inverse();
    const Vec3 before_G = X_GO * before_O;
    const Vec3 p_G = X_GO * p_O;
    const double off = std::max(std::abs(p_G.y()), std::abs(p_G.z()));
    if (p_G.x() > -config_.freeze_distance && p_G.x() < 0.5 && off < 1.0 && book_.Good(next_gate_)) {
      book_.Freeze(next_gate_);
    }
    if (!(before_G.x() < 0.0 && p_G.x() >= 0.0) || off > 2.0) return;
    if (off > 0.5 * book_.opening(next_gate_)) {
      Say("gate_missed", fmt::format("went by gate {} {:.2f} m off its middle", next_gate_, off));
      return;
    }
    Say("gate_passed",
        fmt::format("gate {} passed {:.2f} m off its measured middle", next_gate_, p_G.tail<2>().norm()));
    exiting_ = next_gate_++;
    looks_ = 0;
  }

  void WatchRest(const TrajectoryPoint& setpoint) {
    if ((setpoint.p_O - rest_at_O_).norm() > kRestRadius || std::abs(setpoint.yaw_rate) > 0.15) {
      rest_at_O_ = setpoint.p_O;
      rest_since_ = now();
    }
    if ((setpoint.p_O - recovered_at_O_).norm() > kProgress) recovery_ = 0;
  }

  /// Brakes when the trajectory runs into something that the newest map shows, and no new route can come in time.
  void WatchPath(const TrajectoryPoint& setpoint) {
    if (!new_map_ || !field_) return;
    const auto blocked = planning::FirstBlocked(*trajectory_, now(), *field_, asked_passages_, route_);
    if (!blocked) return;
    const double time_to_stop = setpoint.v_O.norm() / route_.limits.max_acceleration;
    if ((*blocked - now()).Seconds() > time_to_stop + kReactionTime) return;
    if (setpoint.v_O.norm() < 0.1) return;
    if (now() >= quiet_until_) Say("path_blocked", "the map shows an obstacle on the path: braking");
    quiet_until_ = now() + kBlockedQuiet;
    BrakeFrom(setpoint);
  }

  bool Arrived(const TrajectoryPoint& setpoint) {
    if (next_gate_ < book_.size() || !last_had_target_ || now() - rest_since_ < base::Milliseconds(200)) return false;
    if ((setpoint.p_O - TargetInO()).norm() > config_.arrival_radius ||
        (in_->X_OB.p - TargetInO()).norm() > config_.arrival_radius) {
      return false;
    }
    phase_ = Phase::kArrived;
    state_ = StackState::kDone;
    Say("arrived", "hovering at the target");
    return true;
  }

  /// At rest for too long: look again, from elsewhere, or concede something. Never silently.
  void HandleRest(const TrajectoryPoint& setpoint) {
    if (!field_ || !asked_once_) return;
    const Duration rest = now() - rest_since_;
    if (last_ok_ && last_end_ == RouteEnd::kClosedGate) {
      if (rest > config_.look_time) LookAgain(setpoint);
    } else if (rest > config_.stuck_time) {
      Recover(setpoint);
    }
  }

  void LookAgain(const TrajectoryPoint& setpoint) {
    ++looks_;
    rest_since_ = now();
    const auto& fit = book_.Fit(next_gate_);
    const std::string seen =
        fit ? fmt::format("measured to {:.2f} m from {:.1f} m", fit->position_sigma, fit->nearest) : "not seen";
    Say("gate_not_seen", fmt::format("gate {} is {} after look {}", next_gate_, seen, looks_));
    book_.AcceptCoarse(next_gate_);
    if (looks_ >= kLooks) {
      book_.TrustList(next_gate_);
      Say("gate_from_list", fmt::format("gate {} is taken from {}", next_gate_, fit ? "a poor fit" : "the list"));
      return;
    }
    if (looks_ % 2 == 1) Scan(setpoint, 0.6);
  }

  void Recover(const TrajectoryPoint& setpoint) {
    rest_since_ = now();
    recovered_at_O_ = setpoint.p_O;
    const bool unknown = last_ok_ && last_end_ == RouteEnd::kUnknownSpace;
    const std::string why = last_ok_ ? (unknown ? "known-free space ends here" : "the route ends here") : last_reason_;
    Concessions concessions;
    std::string remedy = "looking around";
    switch (recovery_++ % 4) {
      case 1:
        Scan(setpoint, 1.0);
        break;
      case 0:
        concessions.known_free_floor = 0.01;
        if (!unknown) concessions.clearance_scale = 0.85;
        concessions.max_speed = config_.creep_speed;
        remedy = "going on slowly with less margin";
        break;
      case 2:
        Scan(setpoint, 3.2);
        break;
      default:
        concessions.known_free_floor = 0.0;
        concessions.clearance_scale = 0.7;
        concessions.max_speed = config_.creep_speed;
        concessions.ignore_openings = true;
        concessions.limit_climb = false;
        remedy = "creeping on with the least margin";
        break;
    }
    concessions_ = concessions;
    concessions_until_ = now() + kRelaxation;
    if (recovery_ > 1) legs_.clear();  // another way may be better than the last one
    Say(unknown ? "unknown_ahead" : "no_route", why + ": " + remedy);
  }

  void Scan(const TrajectoryPoint& setpoint, double half_angle) {
    TurnThrough({setpoint.yaw + half_angle, setpoint.yaw - half_angle, setpoint.yaw});
    turning_ = true;
  }

  void BrakeFrom(const TrajectoryPoint& state) {
    trajectory_ = Trajectory::Brake(now(), state, route_.limits);
    next_.reset();
    turning_ = false;
    ++generation_;
  }

  Vec3 TargetInO() const { return book_.X_MO().Inverse() * mission_.target; }

  Passage PassageOf(int gate) const {
    return {.gate = gate,
            .X_OG = book_.X_OG(gate),
            .half_opening = 0.5 * book_.opening(gate),
            .closed = !book_.Good(gate),
            .views_O = {}};
  }

  void AskForRoute() {
    if (in_flight_ || !field_ || next_) return;
    if (!new_map_ && now() - asked_at_ < kIdleReplan) return;
    planning::RouteRequest request;
    request.field = field_;
    request.start_time = now() + plan_latency_ + kTakeover;
    request.start = trajectory_->Sample(request.start_time);
    for (int i = 1; i <= kLeadPoints; ++i) {
      request.lead_O.push_back(
          trajectory_->Sample(request.start_time + base::Seconds(route_.limits.knot_period) + kLeadStep * i).p_O);
    }
    if (exiting_ >= 0) request.passages.push_back(PassageOf(exiting_));
    int gate = next_gate_;
    for (; gate < book_.size() && gate < next_gate_ + kOpenAhead; ++gate) {
      Passage passage = PassageOf(gate);
      if (passage.closed) passage.views_O = ViewPoints(passage.X_OG, config_.view_distance, looks_, ground_O_);
      request.passages.push_back(std::move(passage));
      if (request.passages.back().closed) break;
    }
    if (gate >= book_.size()) request.target_O = TargetInO();
    request.free_zones.push_back(
        {takeoff_O_, takeoff_O_ + Vec3(0, 0, config_.takeoff_height), std::max(mission_.takeoff_column_radius, 0.3)});
    // What is being flown was known to be free when it was planned; cells that flicker since do not matter.
    const std::vector<Vec3> flown = trajectory_->Points(request.start_time);
    for (std::size_t i = 1; i < flown.size(); ++i) request.free_zones.push_back({flown[i - 1], flown[i], kFlownRadius});
    const bool relaxed = now() < concessions_until_;
    if (!relaxed) concessions_ = {};
    if (!concessions_.ignore_openings) {
      for (int i = 0; i < book_.size(); ++i) {
        request.openings.push_back({book_.X_OG(i), 0.5 * book_.opening(i)});
      }
    }
    request.previous = legs_;
    request.bounds_low_O = mission_.bounds_low + Vec3::Constant(kBoundsReserve);
    request.bounds_high_O = mission_.bounds_high - Vec3::Constant(kBoundsReserve);
    request.ground_O = ground_O_;
    request.clearance_scale = concessions_.clearance_scale;
    request.known_free_floor = concessions_.known_free_floor;
    request.max_speed = concessions_.max_speed;
    request.limit_climb = concessions_.limit_climb;
    request.seed = seed_;
    request.number = ++asked_count_;
    asked_passages_ = request.passages;
    asked_target_ = request.target_O.has_value();
    asked_generation_ = generation_;
    asked_at_ = now();
    asked_once_ = in_flight_ = true;
    out_->request = std::move(request);
  }

  void SendSetpoint() {
    const bool flying =
        phase_ == Phase::kClimb || phase_ == Phase::kScan || phase_ == Phase::kCourse || phase_ == Phase::kArrived;
    if (phase_ == Phase::kEnded && in_->status.armed && now() >= next_setpoint_) {
      next_setpoint_ = now() + kArmPeriod;
      Send(Land{});
    }
    if (!flying || !trajectory_ || now() < next_setpoint_) return;
    next_setpoint_ = now() + config_.setpoint_period;
    const TrajectoryPoint point = trajectory_->Sample(now());
    Send(PositionSetpoint{point.p_O, point.v_O, point.a_O, base::WrapAngle(point.yaw), point.yaw_rate});
  }

  void Fail(const std::string& kind, const std::string& text) {
    phase_ = Phase::kEnded;
    state_ = StackState::kFailed;
    next_setpoint_ = now();
    Say(kind, text);
  }

  void Send(decltype(Command::what) what) {
    out_->commands.push_back({std::move(what), now(), now() + config_.command_lifetime});
  }
  void Say(const std::string& kind, const std::string& text) { out_->events.push_back({now(), kind, text}); }

  Calibration calibration_;
  Mission mission_;
  GateMissionConfig config_;
  planning::RouteConfig route_;
  Duration plan_latency_;
  std::uint64_t seed_;
  GateBook book_;

  const MissionInput* in_ = nullptr;  // during Update
  MissionOutput* out_ = nullptr;

  Phase phase_ = Phase::kInitialising;
  Phase phase_before_loss_ = Phase::kCourse;
  StackState state_ = StackState::kInitialising;
  Time next_arm_, next_setpoint_, lost_since_, rest_since_, quiet_until_, concessions_until_, asked_at_;
  double ground_O_ = 0.0;
  Vec3 takeoff_O_ = Vec3::Zero();
  Vec3 last_p_O_ = Vec3::Zero();
  Vec3 rest_at_O_ = Vec3::Zero();
  Vec3 recovered_at_O_ = Vec3::Zero();

  std::shared_ptr<const mapping::ClearanceField> field_;
  bool new_map_ = false;
  std::optional<Trajectory> trajectory_;  // being flown
  std::optional<Trajectory> next_;        // takes over at its start
  bool turning_ = false;
  std::uint64_t generation_ = 0;  // grows when the trajectory is changed other than by a route

  bool in_flight_ = false, asked_once_ = false, asked_target_ = false;
  std::uint64_t asked_generation_ = 0, asked_count_ = 0;
  std::vector<Passage> asked_passages_;
  bool last_ok_ = true, last_had_target_ = false;
  RouteEnd last_end_ = RouteEnd::kUnknownSpace;
  std::string last_reason_;
  std::vector<planning::Leg> legs_;
  Concessions concessions_;

  int next_gate_ = 0;
  int exiting_ = -1;  // gate whose corridor is being left
  int looks_ = 0;     // at the next gate, in vain
  int recovery_ = 0;
  std::vector<Vec3> path_O_;
  std::uint64_t revision_ = 0;
};

GateMission::GateMission(const Calibration& calibration, const Mission& mission, const GateMissionConfig& config,
                         const planning::RouteConfig& route, const MapAlignmentConfig& alignment, Duration plan_latency,
                         std::uint64_t seed)
    : impl_(std::make_unique<Impl>(calibration, mission, config, route, alignment, plan_latency, seed)) {}
GateMission::~GateMission() = default;

void GateMission::OnMap(Time now, std::shared_ptr<const mapping::ClearanceField> field,
                        const std::vector<std::optional<perception::GateObservation>>& gates) {
  impl_->OnMap(now, std::move(field), gates);
}
void GateMission::OnRoute(Time now, planning::RouteResult result) { impl_->OnRoute(now, std::move(result)); }
MissionOutput GateMission::Update(const MissionInput& input) { return impl_->Update(input); }
StackState GateMission::state() const { return impl_->state(); }
int GateMission::next_gate() const { return impl_->next_gate(); }
const Transform& GateMission::X_MO() const { return impl_->X_MO(); }
const std::vector<Vec3>& GateMission::path_O() const { return impl_->path_O(); }
std::vector<Transform> GateMission::gates_O() const { return impl_->gates_O(); }
std::uint64_t GateMission::revision() const { return impl_->revision(); }

}  // namespace alula::stack::pilot
