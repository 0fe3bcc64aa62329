#pragma once

#include "base/frames.h"
#include "vehicles/b_spline.h"
#include "vehicles/prescribed.h"

namespace alula::vehicles {

/// Time that runs smoothly: τ(t) stands still before 0, gathers speed over `ramp` seconds (seventh-order smooth step in
/// τ', so τ is C⁴), runs at rate 1, and stops likewise at t = duration (≥ 2 ramp).
class SmoothClock {
 public:
  SmoothClock(double duration, double ramp) : duration_(duration), ramp_(ramp) {}
  struct Reading {
    double tau = 0, rate = 0, second = 0, third = 0;  // τ and its derivatives by t
  };
  Reading At(double t) const;

 private:
  double duration_, ramp_;
};

/// A trajectory and its derivatives at one instant, world axes.
struct MotionSample {
  base::Vec3 p = base::Vec3::Zero(), v = base::Vec3::Zero(), a = base::Vec3::Zero(), jerk = base::Vec3::Zero();
  double yaw = 0, yaw_rate = 0;
  SmoothClock::Reading clock;
};

/// Where a prescribed motion is, t seconds after its standstill ended; at rest before and after.
class PrescribedMotion {
 public:
  /// `config`: a path or sines. Throws base::InputError, `name` first, for a path of less than two different points or
  /// a flight time too short for its ramps.
  PrescribedMotion(const MotionConfig& config, const std::string& name);

  double duration() const { return duration_; }  // s
  MotionSample At(double t) const;

 private:
  MotionSample AlongPath(double t) const;
  MotionSample AlongSines(double t) const;

  double duration_ = 0;
  double knot_interval_ = 1;
  QuinticSpline<base::Vec3> path_;
  QuinticSpline<double> heading_;
  SineMotion sines_;
  bool follows_path_ = false;
};

/// Control points every `spacing` metres along the polygon, the first and the last one five times.
std::vector<base::Vec3> PathControlPoints(const std::vector<base::Vec3>& waypoints, double spacing);
/// Direction of travel at each control point, unwrapped, rad; where the path is vertical the neighbours' direction.
std::vector<double> HeadingControlPoints(const std::vector<base::Vec3>& control);

}  // namespace alula::vehicles
