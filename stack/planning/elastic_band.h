#pragma once

#include <functional>
#include <vector>

#include "base/frames.h"
#include "stack/mapping/clearance_field.h"

namespace alula::stack::planning {

/// A point of a path that smoothing may move, or not.
struct BandPoint {
  base::Vec3 p_O = base::Vec3::Zero();
  bool fixed = false;
};

struct BandOptions {
  int rounds = 150;          // over all scales
  double comfortable = 0.7;  // m of clearance; nearer points are pushed away from obstacles
  double push = 0.05;        // share of the missing clearance that one round pushes
};

/// Smooths a band of about equally spaced points: relaxes Σ‖p[i−2m] − 4p[i−m] + 6p[i] − 4p[i+m] + p[i+2m]‖ (the
/// bending energy's gradient) from coarse m to 1, so that corners become arcs as wide as there is room. A point moves
/// only to where `allowed` says yes. (After Quinlan and Khatib 1993, with bending instead
/// of tension.)
void SmoothBand(std::vector<BandPoint>& band, const mapping::ClearanceField& field,
                const std::function<bool(const base::Vec3&)>& allowed, const BandOptions& options);

/// Appends points from the last point of the band (excluded) to b (included), about `spacing` apart.
void AppendLine(std::vector<BandPoint>& band, const base::Vec3& b_O, double spacing, bool fixed);

}  // namespace alula::stack::planning
