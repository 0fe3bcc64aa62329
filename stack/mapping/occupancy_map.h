#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "stack/mapping/clearance_field.h"
#include "stack/mapping/depth_map.h"

namespace alula::stack::mapping {

/// Probabilistic occupancy with a sensor model whose width grows with the square of the range. Log-odds are natural.
struct OccupancyMapConfig {
  double cell = 0.1;       // m; finer is not supported by the sensor (FINDINGS)
  double max_range = 5.0;  // m along the optical axis; nothing farther is entered, free space is carved up to here
  double disparity_sigma = 0.2;  // px of the depth map; sets σ_z = z² σ_d / (f b)
  double free_sigmas = 3.0;      // rays are free up to z − this·σ_z …
  double free_share_min = 0.5;   // … but at least to this share of z
  double hit = 1.2;              // log-odds of a hit in its cell where σ_z is below half a cell; falls as cell/(2σ_z)
  double miss = 0.5;             // log-odds that a ray takes from a cell it crosses
  double max_log_odds = 3.0;     // clamp of what near hits may reach; far hits reach only a share of it
  double min_log_odds = -2.0;    // clamp of free cells: two near hits must be able to overrule
  double occupied_from = 0.35;   // log-odds; above: occupied
  double free_below = -0.35;     // log-odds; below: free; between the two: unknown
  double guard_sigmas = 1.5;     // nothing is carved within this·σ_z (at least one cell) of a hit along its own ray
  double min_hit_share = 0.15;   // share of the pixels a facing cell would fill that must agree before it counts as hit
  double doubt = 0.1;            // log-odds that a near look into plainness takes from what was only seen from afar …
  double doubt_range = 2.5;      // m; … nearer than this a textured surface would have been matched …
  double doubt_below = 2.0;      // … and above these log-odds it was seen from near: believed
  double max_clearance = 1.5;    // m, where the distance fields are cut
};
void Describe(base::Description& d, OccupancyMapConfig& c);

/// The map of what is free, occupied and unknown in the odometry frame, inside a box. One writer; readers take
/// snapshots.
class OccupancyMap {
 public:
  /// The box low_O … high_O (m) is rounded outwards to whole cells. Throws base::InputError when it is empty or has
  /// more than 64 million cells.
  OccupancyMap(const OccupancyMapConfig& config, const base::Vec3& low_O, const base::Vec3& high_O);
  ~OccupancyMap();
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;

  /// Enters one depth map taken from X_OC, the pose of the rectified left camera (X_OB * depth.X_BC).
  void Insert(const DepthMap& depth, const base::Transform& X_OC);
  /// Declares a standing cylinder free (the take-off column): cells that are not occupied become free.
  void DeclareFree(const base::Vec3& base_O, double radius, double height);
  /// Declares the cells free whose centre lies in the box ±half_extents about X_OG and that are unknown; occupied ones
  /// stay. For the opening of a measured gate before a textureless sky.
  void DeclareFreeBox(const base::Transform& X_OG, const base::Vec3& half_extents);

  CellState State(const base::Vec3& p_O) const;
  double Clearance(const base::Vec3& p_O) const;
  double KnownFreeClearance(const base::Vec3& p_O) const;
  /// Log-odds of the cell at a point; 0 where unknown.
  double LogOdds(const base::Vec3& p_O) const;

  /// The state now, for planners in other threads; the same object until the map changes (copying it takes 1–2 ms).
  std::shared_ptr<const ClearanceField> Snapshot() const;
  /// Centres of the occupied cells in the grid's order, m.
  std::vector<Eigen::Vector3f> OccupiedCells() const;
  /// Grows with every change.
  std::uint64_t revision() const;
  const GridShape& shape() const;
  const OccupancyMapConfig& config() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace alula::stack::mapping
