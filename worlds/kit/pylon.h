#pragma once

#include <string>
#include <vector>

#include "base/frames.h"
#include "worlds/world.h"

namespace alula::worlds {

/// A lattice tower of a single-circuit line: four tapered legs braced by diagonals, three cross-arms (two on one side,
/// one on the other, as triangular circuits hang), an earth-wire peak.
struct PylonConfig {
  double height = 22.0;  // m, of the peak
  double base = 3.6;     // m, side of the square between the feet
  double arm = 3.4;      // m, from the axis to an arm's tip
};
/// Where conductors hang from, in the tower's frame (x along the line, z up).
std::vector<base::Vec3> ArmTips(const PylonConfig& config);
base::Vec3 PeakOf(const PylonConfig& config);

/// Adds "<name>/lower", "<name>/upper", "<name>/arms" and its footings. X_WP: the middle of its foot, x along the line.
void AddPylon(World& world, int steel, int concrete, const std::string& name, const base::Transform& X_WP,
              const PylonConfig& config);

/// An insulator string of caps hung from `top`, `length` m down, as one turned body: "<name>".
void AddInsulator(World& world, int ceramic, const std::string& name, const base::Vec3& top, double length);

}  // namespace alula::worlds
