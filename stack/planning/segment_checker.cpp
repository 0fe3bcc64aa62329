#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stack/planning/global_planner.h"

namespace alula::stack::planning {

using base::Vec3;

namespace {

constexpr double kSlack = 0.02;         // m by which a relaxed end may be left
constexpr double kSmallestStep = 0.02;  // m along a segment, where the clearance is just enough

bool Crosses(const ClosedOpening& opening, const Vec3& a_O, const Vec3& b_O) {
  const base::Transform X_GO = opening.X_OG.Inverse();
  const Vec3 a = X_GO * a_O;
  const Vec3 b = X_GO * b_O;
  if ((a.x() > 0.0) == (b.x() > 0.0)) return false;
  const double share = a.x() / (a.x() - b.x());
  const Vec3 p = a + share * (b - a);
  return std::abs(p.y()) < opening.half && std::abs(p.z()) < opening.half;
}

}  // namespace

SegmentChecker::SegmentChecker(const PlanRequest& request, const GlobalPlannerConfig& config)
    : request_(request), cone_(config.start_cone), tan_climb_(std::tan(config.max_climb_angle)) {
  low_ = request.bounds_low_O;
  high_ = request.bounds_high_O;
  low_.z() = std::max(low_.z(), request.ground_O + config.height_min);
  high_.z() = std::min(high_.z(), request.ground_O + config.height_max);
  // Where the vehicle is and where it has to go belong to the box, whatever the limits say.
  low_ = low_.cwiseMin(request.start_O).cwiseMin(request.goal_O);
  high_ = high_.cwiseMax(request.start_O).cwiseMax(request.goal_O);

  start_clearance_ = request.field->Clearance(request.start_O);
  goal_clearance_ = request.field->Clearance(request.goal_O);
  if (start_clearance_ < request.clearance) {
    relaxed_ = fmt::format("the start is {:.2f} m from an obstacle, {:.2f} m wanted: backing off", start_clearance_,
                           request.clearance);
  }
  if (goal_clearance_ < request.clearance) {
    if (!relaxed_.empty()) relaxed_ += "; ";
    goal_blocked_ = goal_clearance_ < request.clearance_floor;
    relaxed_ +=
        fmt::format("the goal is {:.2f} m from an obstacle, {:.2f} m {}", goal_clearance_,
                    goal_blocked_ ? request.clearance_floor : request.clearance, goal_blocked_ ? "needed" : "wanted");
  }
}

double SegmentChecker::Required(const Vec3& p_O) const {
  double required = request_.clearance;
  if (start_clearance_ < request_.clearance) {
    required = std::min(required, start_clearance_ - kSlack + cone_ * (p_O - request_.start_O).norm());
  }
  if (goal_clearance_ < request_.clearance) {
    required = std::min(required, std::max(goal_clearance_ - kSlack, request_.clearance_floor) +
                                      cone_ * (p_O - request_.goal_O).norm());
  }
  return required;
}

bool SegmentChecker::PointFree(const Vec3& p_O) const {
  if ((p_O.array() < low_.array()).any() || (p_O.array() > high_.array()).any()) return false;
  return request_.field->Clearance(p_O) >= Required(p_O);
}

bool SegmentChecker::SegmentFree(const Vec3& a_O, const Vec3& b_O) const {
  if (!PointFree(a_O) || !PointFree(b_O)) return false;
  const Vec3 d = b_O - a_O;
  if (request_.limit_climb && std::abs(d.z()) > tan_climb_ * d.head<2>().norm() + 0.02) return false;
  for (const ClosedOpening& opening : request_.closed) {
    if (Crosses(opening, a_O, b_O)) return false;
  }
  const double length = d.norm();
  double s = 0.0;
  while (s < length) {
    const Vec3 p = a_O + d * (s / length);
    const double reserve = request_.field->Clearance(p) - Required(p);
    if (reserve < 0.0) return false;
    s += std::max(reserve / (1.0 + cone_), kSmallestStep);
  }
  return true;
}

bool SegmentChecker::PathFree(const std::vector<Vec3>& path_O) const {
  for (std::size_t i = 1; i < path_O.size(); ++i) {
    if (!SegmentFree(path_O[i - 1], path_O[i])) return false;
  }
  return !path_O.empty();
}

}  // namespace alula::stack::planning
