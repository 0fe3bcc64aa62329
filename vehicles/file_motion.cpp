#include "vehicles/file_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/trajectory_file.h"
#include "vehicles/spline_fit.h"

namespace alula::vehicles {
namespace {

using base::Vec3;

std::string Text(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

/// The file's poses as those of our body in our world.
std::vector<base::StampedPose> BodyPoses(const FileMotion& config) {
  std::vector<base::StampedPose> poses = base::ReadTrajectory(config.path);
  const Vec3& a = config.frame_orientation;
  const base::Transform X_WF{base::FromYaw(config.yaw), config.origin};
  const base::Transform X_SB =
      base::Transform{base::FromYawPitchRoll(a.x(), a.y(), a.z()), config.frame_position}.Inverse();
  for (base::StampedPose& pose : poses) pose.X_FS = X_WF * pose.X_FS * X_SB;
  return poses;
}

/// A gap of two knot intervals still leaves every control point a sample nearby.
void RefuseGaps(const FileMotion& config, const std::vector<base::StampedPose>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double gap = (poses[i].time - poses[i - 1].time).Seconds();
    if (gap <= 2 * config.knot_interval) continue;
    throw base::InputError({config.path, poses[i].line}, "timestamp",
                           "follows " + Text(gap, "s") + " after the last one; at most two of motion.knot_interval (" +
                               Text(2 * config.knot_interval, "s") + ") can be bridged");
  }
}

/// A body that stands still and then goes at once would feel an endless jolt.
void RefuseFlyingStart(const FileMotion& config, const std::vector<base::StampedPose>& poses) {
  constexpr double kStandingSpeed = 0.05,
                   kStandingRate = 0.05;  // m/s, rad/s: smoothed over one knot interval, ≤ 0.5 m/s²
  const auto later = std::find_if(poses.begin() + 1, poses.end() - 1, [&](const base::StampedPose& pose) {
    return (pose.time - poses.front().time).Seconds() >= config.knot_interval;
  });
  const double dt = (later->time - poses.front().time).Seconds();
  const double speed = (later->X_FS.p - poses.front().X_FS.p).norm() / dt;
  const double rate = base::Log(poses.front().X_FS.q.conjugate() * later->X_FS.q).norm() / dt;
  if (speed <= kStandingSpeed && rate <= kStandingRate) return;
  throw base::InputError({config.path, poses.front().line}, "",
                         "the trajectory begins in motion (" + Text(speed, "m/s") + ", " + Text(rate, "rad/s") +
                             "), so nothing can stand still before it; set vehicle.standstill: 0 s");
}

}  // namespace

FittedMotion::FittedMotion(const FileMotion& config, double standstill) : standstill_(standstill) {
  const std::vector<base::StampedPose> poses = BodyPoses(config);
  RefuseGaps(config, poses);
  if (standstill > 0) RefuseFlyingStart(config, poses);
  duration_ = (poses.back().time - poses.front().time).Seconds();
  if (duration_ < config.knot_interval) {
    throw base::InputError({config.path}, "",
                           "covers " + Text(duration_, "s") + "; at least motion.knot_interval (" +
                               Text(config.knot_interval, "s") + ") is wanted");
  }
  const double span = standstill + duration_;
  const int segments = std::max(1, static_cast<int>(std::lround(span / config.knot_interval)));
  knot_interval_ = span / segments;

  // The standstill enters as samples too, as dense as those of the file.
  std::vector<double> u;
  std::vector<Vec3> p;
  std::vector<base::Quat> q;
  const double period = duration_ / static_cast<double>(poses.size() - 1);
  const int standing = static_cast<int>(standstill / period);
  for (int i = 0; i < standing + static_cast<int>(poses.size()); ++i) {
    const base::StampedPose& pose = poses[static_cast<std::size_t>(std::max(0, i - standing))];
    const double t = i < standing ? (i - standing) * period : (pose.time - poses.front().time).Seconds();
    u.push_back(std::clamp(Parameter(t), 0.0, static_cast<double>(segments)));
    p.push_back(pose.X_FS.p);
    q.push_back(pose.X_FS.q);
  }
  position_ = QuinticSpline<Vec3>(SplineFit(u, segments).Solve(p));
  attitude_ = FitRotations(u, q, segments);

  double squares_p = 0, squares_q = 0;
  for (std::size_t i = static_cast<std::size_t>(standing); i < u.size(); ++i) {
    squares_p += (position_.Derivative(u[i], 0) - p[i]).squaredNorm();
    squares_q += base::Log(q[i].conjugate() * attitude_.At(u[i]).q).squaredNorm();
  }
  position_rms_ = std::sqrt(squares_p / static_cast<double>(poses.size()));
  attitude_rms_ = std::sqrt(squares_q / static_cast<double>(poses.size()));
  const auto refuse = [&](const char* what, const char* key, double rms, double bound, const char* unit) {
    if (rms <= bound) return;
    throw base::InputError({config.path}, "",
                           "the spline misses the file's " + std::string(what) + " by " + Text(rms, unit) +
                               " (rms) and motion." + key + " allows " + Text(bound, unit) +
                               "; shorten motion.knot_interval (" + Text(config.knot_interval, "s") + ")");
  };
  constexpr double kDegree = M_PI / 180;
  refuse("positions", "position_rms", position_rms_, config.position_rms, "m");
  refuse("attitudes", "attitude_rms", attitude_rms_ / kDegree, config.attitude_rms / kDegree, "deg");
}

Vec3 FittedMotion::Derivative(double t, int k) const {
  return position_.Derivative(Parameter(t), k) / std::pow(knot_interval_, k);
}

FlatAttitude FittedMotion::Attitude(double t) const {
  const RotationSpline::Sample sample = attitude_.At(Parameter(t));
  return {sample.q, sample.w / knot_interval_};
}

}  // namespace alula::vehicles
