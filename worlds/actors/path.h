#pragma once

#include <string>
#include <vector>

#include "base/frames.h"

namespace alula::worlds {

/// Straight lines between waypoints whose corners are rounded by arcs of one radius in the horizontal plane; height
/// runs linearly with the distance from corner to corner. Curvature never exceeds 1 / radius.
class RoundedPath {
 public:
  struct Point {
    base::Vec3 p = base::Vec3::Zero();
    double heading = 0.0;    // rad, of the tangent's horizontal part
    double curvature = 0.0;  // 1/m, horizontal, positive to the left
    double slope = 0.0;      // dz/ds
  };

  /// At least two waypoints (three where closed) that lie apart. An arc takes r·tan(turn / 2) from both of its lines:
  /// throws base::InputError (`whose` begins it) where a line is too short for its arcs or the path turns back on
  /// itself.
  RoundedPath(const std::vector<base::Vec3>& waypoints, bool closed, double radius, const std::string& whose);

  double length() const { return ends_.back(); }  // m
  bool closed() const { return closed_; }
  /// At s metres from the begin: wrapped where the path is closed, else held within it.
  Point At(double s) const;

 private:
  struct Piece {
    base::Vec2 p{0.0, 0.0};  // where it begins
    double heading = 0.0;
    double curvature = 0.0;  // 0: a line
    double z = 0.0, slope = 0.0;
  };
  void Add(const Piece& piece, double length);

  bool closed_;
  std::vector<Piece> pieces_;
  std::vector<double> ends_;  // distance at which each piece ends, m
};

}  // namespace alula::worlds
