#pragma once

#include <vector>

#include "worlds/course.h"

namespace alula::worlds {

/// A thing on the ground as seen from above: the circle it fits in.
struct Footprint {
  base::Vec2 centre{0.0, 0.0};
  double radius = 0.0;
};

/// Which room of the courtyard is taken and which must stay free.
class Placement {
 public:
  explicit Placement(const CoursePlan& course) : course_(course) {}

  /// Whether a thing may stand there: clear of the gates' free room and frames, of pad, target, first and last leg,
  /// and at least kPassableWidth from what stands already. `at_wall`: it may touch a wall, so nobody passes behind it.
  bool IsFree(const Footprint& thing, bool at_wall = false) const;
  void Take(const Footprint& thing) { taken_.push_back(thing); }

 private:
  CoursePlan course_;
  std::vector<Footprint> taken_;
};

}  // namespace alula::worlds
