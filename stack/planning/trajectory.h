#pragma once

#include <optional>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"

namespace alula::stack::planning {

/// A point of a trajectory, in the odometry frame: m, m/s, m/s², rad, rad/s.
struct TrajectoryPoint {
  base::Vec3 p_O = base::Vec3::Zero();
  base::Vec3 v_O = base::Vec3::Zero();
  base::Vec3 a_O = base::Vec3::Zero();
  double yaw = 0.0;  // continuous, not wrapped
  double yaw_rate = 0.0;
};

struct TrajectoryLimits {
  double max_speed = 2.4;             // m/s
  double max_climb_speed = 1.0;       // m/s
  double max_acceleration = 3.0;      // m/s², of the point's acceleration as a whole
  double lateral_share = 0.8;         // share of max_acceleration that curves may use
  double max_yaw_rate = 1.5;          // rad/s
  double max_yaw_acceleration = 6.0;  // rad/s²
  double yaw_look_ahead = 1.0;        // m of path: yaw points to where the vehicle will be
  double turn_first = 0.9;            // rad: from rest, it turns until the path is this near to its heading, then goes
  double knot_period = 0.16;          // s between knots: shorter is nearer to the path, longer has less jerk
};
void Describe(base::Description& d, TrajectoryLimits& c);

/// A geometric curve: uniform cubic B-spline (C²) over control points about equally spaced, with arc length.
class Curve {
 public:
  /// At least two control points; the curve starts and ends at the first and last, along the first and last leg.
  explicit Curve(std::vector<base::Vec3> control);

  double length() const { return arc_.back(); }
  base::Vec3 Position(double s) const;
  base::Vec3 Tangent(double s) const;          // unit
  double Curvature(double s) const;            // 1/m
  double HorizontalCurvature(double s) const;  // 1/m: heading per metre
  /// Arc length of the point nearest to p, searched from `from` on.
  double Nearest(const base::Vec3& p, double from = 0.0) const;

 private:
  double Parameter(double s) const;
  void Derivatives(double u, base::Vec3* p, base::Vec3* d1, base::Vec3* d2) const;

  std::vector<base::Vec3> control_;  // with one phantom at each end
  std::vector<double> arc_;          // arc length at u = i / kSamples
};

/// Speed allowed along a curve, beyond the limits that hold everywhere.
struct SpeedZone {
  double from = 0.0;  // arc length, m
  double to = 0.0;
  double speed = 0.0;  // m/s
};

/// A trajectory in time: uniform cubic B-spline whose control points are where the speed profile is every knot_period.
/// Being weighted means of the profile's, its velocity and acceleration keep the profile's limits; position, velocity
/// and acceleration are continuous (C²), at the start with the state given. Outside [start, end] it stands still at
/// the nearer end (a trajectory with an end speed must be replaced before its end).
class Trajectory {
 public:
  /// Stands at p with a heading.
  static Trajectory Hover(base::Time start, const base::Vec3& p_O, double yaw);
  /// Stands at p and turns through the headings in turn (each rad, not wrapped), at most at `rate`.
  static Trajectory Turn(base::Time start, const base::Vec3& p_O, double yaw, const std::vector<double>& headings,
                         double rate, const TrajectoryLimits& limits);
  /// Brakes along the velocity as hard as the limits allow.
  static Trajectory Brake(base::Time start, const TrajectoryPoint& state, const TrajectoryLimits& limits);

  struct AlongOptions {
    double stop_at = -1.0;   // arc length where it ends, m; negative: the curve's end
    double end_speed = 0.0;  // m/s there
    std::vector<SpeedZone> zones{};
    std::optional<double> final_yaw{};  // rad, at the end
  };
  /// Along a curve that starts at StartPoint(state). Nothing when the state is too fast to keep the limits (braking may
  /// use twice the acceleration before that).
  static std::optional<Trajectory> Along(base::Time start, const TrajectoryPoint& state, const Curve& curve,
                                         const AlongOptions& options, const TrajectoryLimits& limits);
  /// Where a curve has to begin so that a trajectory of this state can follow it: one knot ahead of the state.
  static base::Vec3 StartPoint(const TrajectoryPoint& state, const TrajectoryLimits& limits);

  TrajectoryPoint Sample(base::Time t) const;
  base::Time start() const { return start_; }
  base::Time end() const;      // of the motion; yaw may go on
  base::Time yaw_end() const;  // of the turn
  base::Vec3 end_point() const { return control_.back(); }
  /// Positions every knot from `from` on, for checks and pictures.
  std::vector<base::Vec3> Points(base::Time from) const;

 private:
  base::Time start_;
  double period_ = 0.16;
  std::vector<base::Vec3> control_;  // control_[i + 1] belongs to knot time start + i·period
  std::vector<double> yaw_;          // every kYawPeriod
  std::vector<double> yaw_rate_;
};

}  // namespace alula::stack::planning
