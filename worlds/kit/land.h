#pragma once

#include <functional>
#include <string>
#include <vector>

#include "worlds/kit/terrain.h"
#include "worlds/kit/vegetation.h"

namespace alula::worlds {

/// Ground to the horizon: a fine field where one flies, and coarse land around it that rises to hills, so that no edge
/// of the world shows. The renderers' range ends at 200 m; what lies farther from the field's far side is cut off.
struct LandConfig {
  base::Vec2 half{32.0, 32.0};  // half sides of the fine field, m: multiples of kLandCell
  double cell = 0.5;            // m, of the fine field
  HillsConfig swell{.height = 0.5, .wavelength = 60.0, .octaves = 2};   // of field and land alike
  HillsConfig relief{.height = 0.08, .wavelength = 8.0, .octaves = 3};  // of the field alone
  double reach = 112.0;                                                 // m of land beyond the field
  double hills = 14.0;                                                  // m, of its crest, about
};
inline constexpr double kLandCell = 8.0;  // m, of the land around

struct Land {
  HeightField field;
  HeightField around;  // its lattice holds the field's border
  base::Vec2 half{32.0, 32.0};

  bool InField(const base::Vec2& p, double margin = 0.0) const {
    return std::abs(p.x()) <= half.x() - margin && std::abs(p.y()) <= half.y() - margin;
  }
  double Height(const base::Vec2& p) const { return InField(p) ? HeightAt(field, p) : HeightAt(around, p); }
  base::Vec3 On(const base::Vec2& p) const { return {p.x(), p.y(), Height(p)}; }
};

/// `shape`: what is added to field and land, m (a slope, a valley); may be empty.
Land MakeLand(const LandConfig& config, const std::function<double(const base::Vec2&)>& shape,
              base::RandomStream& random);

/// Adds "ground/…" (the field's tiles) and "land/…" (what lies around, joined to the field's border point by point).
/// Surfaces may be the same; their periods must divide kLandCell.
void AddLand(World& world, const Land& land, const Surface& field, const Surface& around, base::RandomStream& random);

/// Trees far away, as crossed cards merged by the direction in which they stand: "treeline/…".
struct TreeLineConfig {
  double nearest = 30.0;     // m beyond the field's border
  double woods = 0.5;        // share of the land under trees
  double spacing = 7.0;      // m between trees of a wood
  double height_min = 7.0;   // m
  double height_max = 13.0;  // m
  double conifer_share = 0.3;
};
void AddTreeLine(World& world, const Land& land, const TreeLineConfig& config, std::uint64_t seed);

/// A round pad on the ground, which is levelled under it: call it before AddLand. The start is upon it.
void AddPadOn(World& world, Land& land, int material, const base::Vec2& p, double radius, double yaw);

}  // namespace alula::worlds
