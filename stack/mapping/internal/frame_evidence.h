#pragma once

#include <cstdint>
#include <vector>

#include "stack/mapping/occupancy_map.h"

namespace alula::stack::mapping::internal {

/// What one depth map says about the cells of a grid: each cell at most once: hit, crossed, or doubted (a ray
/// on which nothing could be matched goes through it).
class FrameEvidence {
 public:
  struct Hit {
    std::size_t cell = 0;
    double depth = 0.0;  // m, of the first pixel that fell into the cell
    int pixels = 0;
    base::Vec3 p_O;  // of that pixel
  };

  explicit FrameEvidence(const GridShape& shape);

  /// Fills hits(), crossed() and doubted() from a depth map taken from X_OC.
  void Collect(const OccupancyMapConfig& config, const DepthMap& depth, const base::Transform& X_OC);

  const std::vector<Hit>& hits() const { return hits_; }
  const std::vector<std::size_t>& crossed() const { return crossed_; }
  const std::vector<std::size_t>& doubted() const { return doubted_; }
  /// How far a hit at this depth can be trusted to lie in its own cell: 1 near, falling as cell / (2 σ_z).
  static double Sharpness(const OccupancyMapConfig& config, const DepthMap& depth, double z);

 private:
  void AddPixel(const OccupancyMapConfig& config, const DepthMap& depth, double z, const base::Vec3& ray_O,
                const base::Vec3& p_OC);
  void DropThinHits(const OccupancyMapConfig& config, const DepthMap& depth);
  void GuardHits(const OccupancyMapConfig& config, const DepthMap& depth, const base::Vec3& p_OC);
  void AddPlainPixels(const OccupancyMapConfig& config, const DepthMap& depth, const base::Transform& X_OC);
  void AddRay(const base::Vec3& from, const base::Vec3& to, std::vector<base::Vec3>& ends);
  void CrossCells(const base::Vec3& p_OC, const std::vector<base::Vec3>& ends, std::vector<std::size_t>& out);

  GridShape shape_;
  std::uint32_t frame_ = 0;
  // Stamps say in which frame a cell was last an end, guarded or crossed; they spare clearing the grids.
  std::vector<std::uint32_t> end_stamp_;
  std::vector<std::uint32_t> kept_stamp_;  // hit or guarded, later crossed
  std::vector<std::uint32_t> hit_stamp_;
  std::vector<std::uint32_t> hit_slot_;
  std::vector<Hit> hits_;
  std::vector<base::Vec3> free_ends_;   // of rays
  std::vector<base::Vec3> plain_ends_;  // the same, of rays on which nothing could be matched
  std::vector<std::size_t> crossed_;
  std::vector<std::size_t> doubted_;
};

}  // namespace alula::stack::mapping::internal
