#include "worlds/actors/path.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace alula::worlds {
namespace {

using base::Vec2;

double HeadingOf(const Vec2& v) { return std::atan2(v.y(), v.x()); }

}  // namespace

RoundedPath::RoundedPath(const std::vector<base::Vec3>& waypoints, bool closed, double radius, const std::string& whose)
    : closed_(closed) {
  const std::size_t n = waypoints.size();
  if (n < (closed ? 3U : 2U)) throw base::InputError(whose + ": too few waypoints for a path");
  const auto at = [&](std::size_t i) -> const base::Vec3& { return waypoints[i % n]; };
  const std::size_t lines = closed ? n : n - 1;

  // What the arc at each corner takes from its two lines; none at the ends of an open path.
  std::vector<double> cut(n, 0.0);
  std::vector<double> turn(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) continue;
    const Vec2 in = (at(i) - at(i + n - 1)).head<2>();
    const Vec2 out = (at(i + 1) - at(i)).head<2>();
    turn[i] = base::WrapAngle(HeadingOf(out) - HeadingOf(in));
    if (std::abs(turn[i]) > 3.0) throw base::InputError(whose + ": the path turns back on itself at a waypoint");
    cut[i] = radius * std::tan(0.5 * std::abs(turn[i]));
  }
  for (std::size_t i = 0; i < lines; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec2 way = (at(j) - at(i)).head<2>();
    const double length = way.norm();
    if (!(length > 1e-6) || length < cut[i] + cut[j] - 1e-9) {
      throw base::InputError(whose + ": two waypoints lie too close together for turns of " + std::to_string(radius) +
                             " m");
    }
    // Height runs over the line and the halves of the arcs at its ends.
    const double arcs = 0.5 * radius * (std::abs(turn[i]) + std::abs(turn[j]));
    const double straight = length - cut[i] - cut[j];
    const double slope = (at(j).z() - at(i).z()) / (straight + arcs);
    const double heading = HeadingOf(way);
    const double first_half = 0.5 * radius * std::abs(turn[i]);
    Piece piece{at(i).head<2>() + cut[i] * way / length, heading, 0.0, at(i).z() + slope * first_half, slope};
    if (turn[i] != 0.0) {  // second half of the arc at i
      const double curvature = std::copysign(1.0 / radius, turn[i]);
      const Vec2 left(-std::sin(heading), std::cos(heading));
      const Vec2 centre = piece.p + left / curvature;
      const double before = heading - 0.5 * turn[i];
      const Vec2 begin = centre + Vec2(std::sin(before), -std::cos(before)) / curvature;
      Add({begin, before, curvature, at(i).z(), slope}, first_half);
    }
    Add(piece, straight);
    if (turn[j] != 0.0) {  // first half of the arc at j
      Piece arc = piece;
      arc.p += straight * way / length;
      arc.z += slope * straight;
      arc.curvature = std::copysign(1.0 / radius, turn[j]);
      Add(arc, 0.5 * radius * std::abs(turn[j]));
    }
  }
}

void RoundedPath::Add(const Piece& piece, double length) {
  if (!(length > 0.0)) return;
  pieces_.push_back(piece);
  ends_.push_back((ends_.empty() ? 0.0 : ends_.back()) + length);
}

RoundedPath::Point RoundedPath::At(double s) const {
  s = closed_ ? s - length() * std::floor(s / length()) : std::clamp(s, 0.0, length());
  const auto found = std::upper_bound(ends_.begin(), ends_.end(), s);
  const auto i = std::min(static_cast<std::size_t>(found - ends_.begin()), pieces_.size() - 1);
  const Piece& piece = pieces_[i];
  const double along = s - (i == 0 ? 0.0 : ends_[i - 1]);
  Point point;
  point.heading = piece.heading + piece.curvature * along;
  point.curvature = piece.curvature;
  point.slope = piece.slope;
  Vec2 p = piece.p;
  if (piece.curvature == 0.0) {
    p += along * Vec2(std::cos(piece.heading), std::sin(piece.heading));
  } else {
    p += Vec2(std::sin(point.heading) - std::sin(piece.heading), std::cos(piece.heading) - std::cos(point.heading)) /
         piece.curvature;
  }
  point.p = {p.x(), p.y(), piece.z + piece.slope * along};
  return point;
}

}  // namespace alula::worlds
