#include "vehicles/prescribed_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"

namespace alula::vehicles {

using base::Vec3;

namespace {
// A quintic spline starts at its first control point, at rest, when that point stands five times.
constexpr int kRepeated = QuinticSpline<Vec3>::kDegree;
}  // namespace

SmoothClock::Reading SmoothClock::At(double t) const {
  if (t <= 0) return {};
  if (t >= duration_) return {duration_ - ramp_, 0, 0, 0};
  const bool stopping = t > duration_ - ramp_;
  if (!stopping && t >= ramp_) return {t - 0.5 * ramp_, 1, 0, 0};
  // Rate x⁴ (35 − 84 x + 70 x² − 20 x³), mirrored in time at the end.
  const double x = (stopping ? duration_ - t : t) / ramp_;
  const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  const double tau = ramp_ * x5 * (7 - 14 * x + 10 * x2 - 2.5 * x3);
  const double rate = x4 * (35 - 84 * x + 70 * x2 - 20 * x3);
  const double second = 140 * x3 * (1 - x) * (1 - x) * (1 - x) / ramp_;
  const double third = 420 * x2 * (1 - x) * (1 - x) * (1 - 2 * x) / (ramp_ * ramp_);
  if (stopping) return {duration_ - ramp_ - tau, rate, -second, third};
  return {tau, rate, second, third};
}

std::vector<Vec3> PathControlPoints(const std::vector<Vec3>& waypoints, double spacing) {
  double length = 0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) length += (waypoints[i] - waypoints[i - 1]).norm();
  const int steps = std::max(1, static_cast<int>(std::lround(length / spacing)));
  std::vector<Vec3> control(kRepeated - 1, waypoints.front());
  std::size_t leg = 1;
  double leg_start = 0;  // arc length at waypoint leg − 1
  for (int k = 0; k <= steps; ++k) {
    const double s = length * k / steps;
    double leg_length = (waypoints[leg] - waypoints[leg - 1]).norm();
    while (s > leg_start + leg_length && leg + 1 < waypoints.size()) {
      leg_start += leg_length;
      ++leg;
      leg_length = (waypoints[leg] - waypoints[leg - 1]).norm();
    }
    const double share = leg_length > 0 ? std::min(1.0, (s - leg_start) / leg_length) : 0.0;
    control.push_back(waypoints[leg - 1] + share * (waypoints[leg] - waypoints[leg - 1]));
  }
  control.insert(control.end(), kRepeated - 1, control.back());
  return control;
}

std::vector<double> HeadingControlPoints(const std::vector<Vec3>& control) {
  const int n = static_cast<int>(control.size());
  std::vector<std::optional<double>> known(control.size());
  for (int i = 0; i < n; ++i) {
    const Vec3 along = control[static_cast<std::size_t>(std::min(i + 1, n - 1))] -
                       control[static_cast<std::size_t>(std::max(i - 1, 0))];
    if (along.head<2>().norm() > 0.1 + 0.3 * std::abs(along.z())) {
      known[static_cast<std::size_t>(i)] = std::atan2(along.y(), along.x());
    }
  }
  const auto first = std::find_if(known.begin(), known.end(), [](const auto& k) { return k.has_value(); });
  double last = first == known.end() ? 0.0 : **first;
  std::vector<double> heading;
  for (const auto& k : known) {
    if (k) last += base::WrapAngle(*k - last);
    heading.push_back(last);
  }
  return heading;
}

PrescribedMotion::PrescribedMotion(const MotionConfig& config, const std::string& name) {
  if (const auto* path = std::get_if<PathMotion>(&config)) {
    double length = 0;
    for (std::size_t i = 1; i < path->waypoints.size(); ++i) {
      length += (path->waypoints[i] - path->waypoints[i - 1]).norm();
    }
    if (!(length > 0)) throw base::InputError(name + ": motion.waypoints: a path needs two different points");
    const std::vector<Vec3> control = PathControlPoints(path->waypoints, path->speed * path->knot_interval);
    path_ = QuinticSpline<Vec3>(control);
    heading_ = QuinticSpline<double>(HeadingControlPoints(control));
    knot_interval_ = path->knot_interval;
    duration_ = path_.segments() * knot_interval_;
    follows_path_ = true;
  } else {
    sines_ = std::get<SineMotion>(config);
    if (sines_.flight_time < 2 * sines_.ramp) {
      throw base::InputError(name + ": motion.flight_time: must be at least twice the ramp");
    }
    duration_ = sines_.flight_time;
  }
}

MotionSample PrescribedMotion::At(double t) const { return follows_path_ ? AlongPath(t) : AlongSines(t); }

MotionSample PrescribedMotion::AlongPath(double t) const {
  const double u = t / knot_interval_;
  const bool moves = t > 0 && t < duration_;
  MotionSample s;
  s.p = path_.Derivative(u, 0);
  s.yaw = heading_.Derivative(u, 0);
  s.clock = SmoothClock(duration_, 0.25 * duration_).At(t);
  if (!moves) return s;
  const double h = knot_interval_;
  s.v = path_.Derivative(u, 1) / h;
  s.a = path_.Derivative(u, 2) / (h * h);
  s.jerk = path_.Derivative(u, 3) / (h * h * h);
  s.yaw_rate = heading_.Derivative(u, 1) / h;
  return s;
}

MotionSample PrescribedMotion::AlongSines(double t) const {
  MotionSample s;
  s.clock = SmoothClock(duration_, sines_.ramp).At(t);
  const auto& [tau, r1, r2, r3] = s.clock;
  Vec3 d1 = Vec3::Zero(), d2 = Vec3::Zero(), d3 = Vec3::Zero();  // by τ
  s.p = sines_.start;
  for (const SineTerm& term : sines_.terms) {
    const double w = 2 * M_PI * term.frequency;
    for (int i = 0; i < 3; ++i) {
      const double a = term.amplitude[i], x = w * tau + term.phase[i];
      s.p[i] += a * (std::sin(x) - std::sin(term.phase[i]));
      d1[i] += a * w * std::cos(x);
      d2[i] -= a * w * w * std::sin(x);
      d3[i] -= a * w * w * w * std::cos(x);
    }
  }
  s.v = d1 * r1;
  s.a = d2 * r1 * r1 + d1 * r2;
  s.jerk = d3 * r1 * r1 * r1 + 3 * d2 * r1 * r2 + d1 * r3;
  const double w = 2 * M_PI * sines_.yaw_frequency;
  s.yaw = sines_.yaw + sines_.yaw_amplitude * std::sin(w * tau);
  s.yaw_rate = sines_.yaw_amplitude * w * std::cos(w * tau) * r1;
  return s;
}

}  // namespace alula::vehicles
