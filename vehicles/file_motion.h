#pragma once

#include "base/frames.h"
#include "vehicles/b_spline.h"
#include "vehicles/flatness.h"
#include "vehicles/prescribed.h"
#include "vehicles/rotation_spline.h"

namespace alula::vehicles {

/// A recorded trajectory as a smooth one: position and attitude are quintic B-splines (C⁴) on the same uniform knots,
/// fitted to the file's poses by least squares, so that an IMU integrates to exactly the poses that cameras see.
/// Before its first pose it stands still for `standstill` seconds, which are part of the splines.
class FittedMotion {
 public:
  /// Throws base::InputError: what ReadTrajectory throws; a gap longer than two knot intervals; a file that begins in
  /// motion although a standstill is wanted; a fit that misses the bounds of `config`.
  FittedMotion(const FileMotion& config, double standstill);

  double duration() const { return duration_; }  // s, without the standstill
  base::Vec3 Position(double t) const { return Derivative(t, 0); }
  base::Vec3 Velocity(double t) const { return Derivative(t, 1); }
  FlatAttitude Attitude(double t) const;
  /// Root mean squares of the fit's residuals.
  double position_rms() const { return position_rms_; }  // m
  double attitude_rms() const { return attitude_rms_; }  // rad

 private:
  double Parameter(double t) const { return (t + standstill_) / knot_interval_; }
  base::Vec3 Derivative(double t, int k) const;

  double standstill_, duration_, knot_interval_;
  double position_rms_ = 0, attitude_rms_ = 0;
  QuinticSpline<base::Vec3> position_;
  RotationSpline attitude_;
};

}  // namespace alula::vehicles
