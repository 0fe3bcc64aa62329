#include "stack/planning/route_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stack/planning/elastic_band.h"

namespace alula::stack::planning {

using base::Vec3;

namespace {

constexpr double kOnAxis = 0.35;         // m off the axis within which a start counts as in the passage already
constexpr double kJoinAxis = 0.6;        // m of flight in which such a start comes back to the axis
constexpr double kStopMargin = 0.08;     // m kept between the stop and the end of known-free space
constexpr double kOwnSpace = 0.1;        // m about the start: where the vehicle is, it is free
constexpr double kOpeningReserve = 0.1;  // m by which closed openings are larger than they are

Vec3 AxisPoint(const Passage& passage, double x) { return passage.X_OG * Vec3(x, 0, 0); }

double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length_squared = d.squaredNorm();
  const double share = length_squared > 1e-12 ? std::clamp((p - a).dot(d) / length_squared, 0.0, 1.0) : 0.0;
  return (p - a - share * d).norm();
}

/// One route under construction.
class RouteBuilder {
 public:
  RouteBuilder(const RouteRequest& request, const RouteConfig& config, GlobalPlanner& planner)
      : request_(request), config_(config), planner_(planner), limits_(config.limits) {
    if (request.max_speed > 0.0) limits_.max_speed = std::min(limits_.max_speed, request.max_speed);
  }

  RouteResult Build() {
    Begin();
    if (!AddWay()) return std::move(result_);
    if (band_.size() < 2) AppendLine(band_, band_.back().p_O + Vec3(1e-3, 0, 0), config_.point_spacing, true);
    for (const bool smooth : {true, false}) {
      if (Fly(smooth)) break;
    }
    return std::move(result_);
  }

 private:
  /// Through the passages and on to the target. Where only what comes after a passage has no way, the route ends behind
  /// that passage: from there the map will show more.
  bool AddWay() {
    bool passed = false;
    for (const Passage& passage : request_.passages) {
      if (!AddPassage(passage)) return EndBehindPassage(passed);
      passed = passed || !passage.closed;
    }
    if (!request_.target_O || (!request_.passages.empty() && request_.passages.back().closed)) return true;
    return AddLeg(*request_.target_O, -1) || EndBehindPassage(passed);
  }

  bool EndBehindPassage(bool passed) {
    no_way_on_ = passed;
    return passed;
  }

  /// The first stretch goes on as the vehicle moves, so that the curve leaves along its velocity.
  void Begin() {
    start_O_ = Trajectory::StartPoint(request_.start, limits_);
    band_.push_back({start_O_, true});
    const Vec3 velocity = request_.start.v_O + request_.start.a_O * (0.5 * limits_.knot_period);
    const double speed = velocity.norm();
    if (speed > 0.25 && request_.lead_O.empty()) {
      AppendLine(band_, start_O_ + velocity / speed * (0.2 + 0.1 * speed), 0.5 * config_.point_spacing, true);
    } else if (speed > 0.25) {
      for (const Vec3& p : request_.lead_O) {
        if ((p - band_.back().p_O).norm() < 0.4 * config_.point_spacing || (p - start_O_).dot(velocity) < 0.0) continue;
        band_.push_back({p, true});
      }
    }
    start_clearance_ = request_.field->Clearance(start_O_);
  }

  bool AddPassage(const Passage& passage) {
    const Vec3 cursor_G = passage.X_OG.Inverse() * band_.back().p_O;
    const bool inside = cursor_G.x() > -config_.passage_before - 0.3 && cursor_G.x() < config_.passage_after &&
                        cursor_G.tail<2>().norm() < kOnAxis;
    if (passage.closed) return AddClosed(passage, inside);
    // The lead may end beyond a passage that the vehicle is still in.
    const Vec3 start_G = passage.X_OG.Inverse() * request_.start.p_O;
    const bool through = start_G.x() > -config_.passage_before && start_G.tail<2>().norm() < kOnAxis &&
                         cursor_G.x() >= config_.passage_after;
    if (through) return true;
    if (inside) {
      const double join = cursor_G.x() + kJoinAxis;
      if (cursor_G.tail<2>().norm() > 0.01 && join < config_.passage_after) {
        AppendLine(band_, AxisPoint(passage, join), config_.point_spacing, false);
      }
    } else if (!AddLeg(AxisPoint(passage, -config_.passage_before), passage.gate)) {
      return false;
    }
    band_.back().fixed = true;
    AppendLine(band_, AxisPoint(passage, config_.passage_after), config_.point_spacing, true);
    return true;
  }

  /// Up to a view point; beyond it the way is only sketched, for the camera to look along.
  bool AddClosed(const Passage& passage, bool inside) {
    bool reached = inside;
    std::string reasons;
    if (inside) stop_at_point_ = band_.back().p_O;
    for (const Vec3& view : passage.views_O) {
      if (reached) break;
      reached = AddLeg(view, passage.gate);
      if (reached)
        stop_at_point_ = view;
      else
        reasons = result_.reason;
    }
    if (!reached) return false;
    // From rest at the view point nothing is left to fly; the sketch still turns the camera to the gate.
    const Vec3 entry = AxisPoint(passage, -0.5 * config_.passage_before);
    if ((entry - band_.back().p_O).norm() > 0.05) AppendLine(band_, entry, config_.point_spacing, false);
    AppendLine(band_, AxisPoint(passage, config_.passage_after), config_.point_spacing, true);
    return true;
  }

  bool AddLeg(const Vec3& goal_O, int gate) {
    if ((goal_O - band_.back().p_O).norm() < 0.05) {
      result_.legs.push_back({gate, {band_.back().p_O}});
      return true;
    }
    PlanRequest plan;
    plan.field = request_.field;
    plan.start_O = band_.back().p_O;
    plan.goal_O = goal_O;
    plan.clearance = config_.clearance * request_.clearance_scale;
    plan.clearance_floor = std::min(config_.clearance_floor, plan.clearance);
    plan.bounds_low_O = request_.bounds_low_O;
    plan.bounds_high_O = request_.bounds_high_O;
    plan.ground_O = request_.ground_O;
    plan.limit_climb = request_.limit_climb;
    for (const ClosedOpening& opening : request_.openings) {
      plan.closed.push_back({opening.X_OG, opening.half + kOpeningReserve});
    }
    for (const Leg& leg : request_.previous) {
      if (leg.gate == gate && leg.path_O.size() > 2) plan.previous = {leg.path_O.begin() + 1, leg.path_O.end() - 1};
    }
    plan.seed = request_.seed;
    plan.number = request_.number * 16 + result_.legs.size();
    PlanResult planned = planner_.Plan(plan);
    if (!planned.found && plan.limit_climb) {
      // A goal almost overhead cannot be reached at a gentle angle in little room.
      PlanRequest steep = plan;
      steep.limit_climb = false;
      planned = planner_.Plan(steep);
      if (planned.found) planned.reason += planned.reason.empty() ? "steep climb" : "; steep climb";
    }
    if (planned.source == PlanResult::Source::kSearch) ++result_.searches;
    if (!planned.reason.empty()) {
      result_.reason = (gate < 0 ? "target: " : fmt::format("gate {}: ", gate)) + planned.reason;
    }
    if (!planned.found) return false;
    for (std::size_t i = 1; i < planned.path_O.size(); ++i) {
      AppendLine(band_, planned.path_O[i], config_.point_spacing, false);
    }
    result_.legs.push_back({gate, std::move(planned.path_O)});
    return true;
  }

  /// Clearance that the flown curve needs at a point: less near a start that is itself too near to something.
  double Required(const Vec3& p_O) const {
    double required = std::min(config_.flown_clearance, config_.clearance) * request_.clearance_scale;
    if (start_clearance_ < required + 0.03) {
      required = std::min(required, start_clearance_ - 0.03 + config_.planner.start_cone * (p_O - start_O_).norm());
    }
    const double goal_clearance = request_.field->Clearance(band_.back().p_O);
    if (goal_clearance < required + 0.03) {
      required = std::min(required, std::max(goal_clearance - 0.03, 0.0) +
                                        config_.planner.start_cone * (p_O - band_.back().p_O).norm());
    }
    return required;
  }

  bool Clear(const Vec3& p_O) const {
    for (const Passage& passage : request_.passages) {
      if (!passage.closed && InsideExempt(passage, p_O, config_.passage_exempt)) return true;
    }
    return request_.field->Clearance(p_O) >= Required(p_O);
  }

  bool KnownFree(const Vec3& p_O, double radius) const {
    if ((p_O - start_O_).norm() < kOwnSpace) return true;
    for (const FreeZone& zone : request_.free_zones) {
      if (DistanceToSegment(p_O, zone.a_O, zone.b_O) < zone.radius) return true;
    }
    for (const Passage& passage : request_.passages) {
      const Vec3 a = AxisPoint(passage, -config_.passage_exempt);
      const Vec3 b = AxisPoint(passage, config_.passage_after + 0.15);
      if (!passage.closed && DistanceToSegment(p_O, a, b) < 0.3) return true;
    }
    return request_.field->KnownFreeClearance(p_O) >= radius;
  }

  /// Where the trajectory has to stop, and why.
  double StopArc(const Curve& curve) {
    double stop = curve.length();
    result_.end = RouteEnd::kTarget;
    if (stop_at_point_) {
      stop = curve.Nearest(*stop_at_point_);
      result_.end = RouteEnd::kClosedGate;
    } else if (no_way_on_) {
      result_.end = RouteEnd::kNoWayOn;
    }
    const double floor = request_.known_free_floor >= 0.0 ? request_.known_free_floor : config_.known_free_floor;
    barely_seen_.clear();
    for (double s = 0.0; s < stop; s += 0.05) {
      const Vec3 p = curve.Position(s);
      if (KnownFree(p, config_.known_free_radius)) continue;
      if (KnownFree(p, floor)) {
        const bool hull_fits = KnownFree(p, config_.known_free_hull);
        barely_seen_.push_back({s - 0.05, s + 0.05, hull_fits ? config_.barely_seen_speed : config_.creep_speed});
        continue;
      }
      result_.end = RouteEnd::kUnknownSpace;
      return std::max(0.0, s - 0.05 - kStopMargin);
    }
    return stop;
  }

  std::vector<SpeedZone> Zones(const Curve& curve) const {
    std::vector<SpeedZone> zones = barely_seen_;
    for (const Passage& passage : request_.passages) {
      if (passage.closed) continue;
      const double from = curve.Nearest(AxisPoint(passage, -config_.passage_before));
      zones.push_back({from, curve.Nearest(AxisPoint(passage, 0.4), from), config_.passage_speed});
    }
    return zones;
  }

  bool Fly(bool smooth) {
    std::vector<BandPoint> band = band_;
    const auto allowed = [this](const Vec3& p) {
      return (p.array() >= request_.bounds_low_O.array()).all() &&
             (p.array() <= request_.bounds_high_O.array()).all() && Clear(p);
    };
    BandOptions options{.rounds = smooth ? config_.smoothing_rounds : 9, .comfortable = config_.comfortable_clearance};
    SmoothBand(band, *request_.field, allowed, options);
    std::vector<Vec3> control;
    for (const BandPoint& point : band) control.push_back(point.p_O);
    const Curve curve(std::move(control));
    const double stop = StopArc(curve);
    Trajectory::AlongOptions along{.stop_at = stop, .end_speed = 0.0, .zones = Zones(curve), .final_yaw = std::nullopt};
    const auto trajectory = Trajectory::Along(request_.start_time, request_.start, curve, along, limits_);
    result_.ok = false;
    if (!trajectory) {
      result_.reason =
          fmt::format("too fast ({:.2f} m/s) to stop {:.2f} m ahead, where {}", request_.start.v_O.norm(), stop,
                      result_.end == RouteEnd::kUnknownSpace ? "known-free space ends" : "it has to");
      return false;
    }
    for (base::Time t = trajectory->start(); t < trajectory->end(); t += base::Milliseconds(20)) {
      const Vec3 p = trajectory->Sample(t).p_O;
      if (Clear(p)) continue;
      result_.reason = fmt::format("the smoothed path comes within {:.2f} m of an obstacle at ({:.2f}, {:.2f}, {:.2f})",
                                   request_.field->Clearance(p), p.x(), p.y(), p.z());
      return false;
    }
    result_.ok = true;
    result_.trajectory = trajectory;
    result_.flown_length = stop;
    result_.length = curve.length();
    result_.path_O.clear();
    for (double s = 0.0; s < curve.length(); s += 0.25) result_.path_O.push_back(curve.Position(s));
    result_.path_O.push_back(curve.Position(curve.length()));
    return true;
  }

  const RouteRequest& request_;
  const RouteConfig& config_;
  GlobalPlanner& planner_;
  TrajectoryLimits limits_;
  RouteResult result_;
  std::vector<BandPoint> band_;
  Vec3 start_O_ = Vec3::Zero();
  double start_clearance_ = 0.0;
  std::optional<Vec3> stop_at_point_;
  std::vector<SpeedZone> barely_seen_;
  bool no_way_on_ = false;
};

}  // namespace

bool InsideExempt(const Passage& passage, const Vec3& p_O, double exempt) {
  const Vec3 p_G = passage.X_OG.Inverse() * p_O;
  return std::abs(p_G.x()) < exempt && std::abs(p_G.y()) < passage.half_opening &&
         std::abs(p_G.z()) < passage.half_opening;
}

RouteResult PlanRoute(const RouteRequest& request, const RouteConfig& config, GlobalPlanner& planner) {
  return RouteBuilder(request, config, planner).Build();
}

std::optional<base::Time> FirstBlocked(const Trajectory& trajectory, base::Time from,
                                       const mapping::ClearanceField& field, const std::vector<Passage>& passages,
                                       const RouteConfig& config) {
  const Vec3 here = trajectory.Sample(from).p_O;
  const double clearance_here = field.Clearance(here);
  for (base::Time t = from; t <= trajectory.end(); t += base::Milliseconds(20)) {
    const Vec3 p = trajectory.Sample(t).p_O;
    const bool exempt = std::any_of(passages.begin(), passages.end(), [&](const Passage& passage) {
      return !passage.closed && InsideExempt(passage, p, config.passage_exempt);
    });
    if (exempt) continue;
    double required = config.clearance_floor - 0.02;  // cells flicker: less than what a new path must keep
    required = std::min(required, clearance_here - 0.05 + config.planner.start_cone * (p - here).norm());
    if (field.Clearance(p) < required) return t;
  }
  return std::nullopt;
}

void Describe(base::Description& d, RouteConfig& c) {
  d.Field("clearance", c.clearance,
          {.unit = "m", .meaning = "planned distance of the vehicle's centre to obstacles", .min = 0.05, .max = 3});
  d.Field("flown_clearance", c.flown_clearance,
          {.unit = "m", .meaning = "the same for the smoothed curve", .min = 0.05, .max = 3});
  d.Field("clearance_floor", c.clearance_floor,
          {.unit = "m", .meaning = "what relaxed starts and goals keep", .min = 0.0, .max = 3});
  d.Field("comfortable_clearance", c.comfortable_clearance,
          {.unit = "m", .meaning = "nearer to obstacles, smoothing pushes away", .min = 0.0, .max = 3});
  d.Field("known_free_radius", c.known_free_radius,
          {.unit = "m", .meaning = "ball that should have been seen free wherever it flies", .min = 0.0, .max = 2});
  d.Field(
      "known_free_hull", c.known_free_hull,
      {.unit = "m", .meaning = "ball of the hull's size: it creeps where less was seen free", .min = 0.0, .max = 2});
  d.Field("known_free_floor", c.known_free_floor,
          {.unit = "m",
           .meaning = "ball that must have been seen free: it stops before where it was not",
           .min = 0.0,
           .max = 2});
  d.Field("barely_seen_speed", c.barely_seen_speed,
          {.unit = "m/s", .meaning = "where little more than the hull's ball was seen free", .min = 0.1, .max = 10});
  d.Field("creep_speed", c.creep_speed,
          {.unit = "m/s", .meaning = "where less than the hull's ball was seen free", .min = 0.1, .max = 10});
  d.Field("passage_before", c.passage_before,
          {.unit = "m", .meaning = "straight flight before a gate", .min = 0.3, .max = 5});
  d.Field("passage_after", c.passage_after,
          {.unit = "m", .meaning = "straight flight after a gate", .min = 0.3, .max = 5});
  d.Field(
      "passage_exempt", c.passage_exempt,
      {.unit = "m", .meaning = "to each side of the opening the gate's fit decides, not the map", .min = 0, .max = 3});
  d.Field("passage_speed", c.passage_speed, {.unit = "m/s", .meaning = "speed through a gate", .min = 0.1, .max = 10});
  d.Field("point_spacing", c.point_spacing,
          {.unit = "m", .meaning = "between control points of the curve", .min = 0.05, .max = 1});
  d.Field("smoothing_rounds", c.smoothing_rounds, {.meaning = "rounds of the elastic band", .min = 0, .max = 5000});
  d.Field("limits", c.limits, {.meaning = "speed, acceleration and heading"});
  d.Field("planner", c.planner, {.meaning = "the search for a way"});
}

}  // namespace alula::stack::planning
