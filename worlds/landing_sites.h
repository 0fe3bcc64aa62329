#pragma once

#include <cstdint>
#include <vector>

#include "base/frames.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Where a vehicle may be set down, from the world's geometry alone, as a grid seen from above.
///
/// top(i, j)      height of the highest surface in the cell, and whether it can be stood on (the object collides)
/// fit at (i, j)  plane z = c + sx x + sy y through the tops within `footprint` of the cell's middle (least squares)
/// good(i, j)     all tops within the footprint are there and can be stood on, the plane's slope atan |(sx, sy)| is at
///                most `slope_max`, and no top is off the plane by more than `roughness_max`
/// safe(i, j)     good everywhere within `radius` + `margin`
struct LandingConfig {
  double cell = 0.1;            // m
  double footprint = 0.2;       // m: holds legs and hull of a small quadrotor
  double slope_max = 0.17;      // rad: 10°, where legs on grass hold well and rotors clear the ground
  double roughness_max = 0.02;  // m: under the ground clearance of such a vehicle's belly
  double radius = 0.2;          // m, of the vehicle's hull
  double margin = 0.5;          // m more, for what guidance and wind add
};

struct LandingSites {
  base::Vec2 low{0.0, 0.0};  // of the grid's corner, m
  double cell = 0.1;         // m
  int columns = 0;           // along x
  int rows = 0;              // along y
  std::vector<float> top;    // m; −infinity where there is nothing
  std::vector<std::uint8_t> good;
  std::vector<std::uint8_t> safe;

  std::size_t Index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }
  base::Vec2 Middle(int i, int j) const { return low + cell * base::Vec2(i + 0.5, j + 0.5); }
  /// Share of the grid that is safe.
  double SafeShare() const;
};

/// Over the world's bounds; surfaces above their top do not count. Tops are kept by cell from the triangles' corners,
/// from points along their edges half a cell apart (carried to the cell's middle along a gentle face), and from the
/// cells' middles that lie within them, so that neither a wire nor the rim of a wall slips between cells.
LandingSites FindLandingSites(const World& world, const LandingConfig& config = {});

}  // namespace alula::worlds
