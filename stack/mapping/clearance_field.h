#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/frames.h"

namespace alula::stack::mapping {

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// Dense grid of cells of the odometry frame: cell (i, j, k) covers low + cell·[i, i+1) × …; k (up) runs fastest.
struct GridShape {
  base::Vec3 low_O = base::Vec3::Zero();
  double cell = 0.1;  // m
  std::array<int, 3> size{};

  std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
  std::size_t Index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * size[1] + static_cast<std::size_t>(j)) * size[2] + k;
  }
  bool Contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  base::Vec3 Centre(int i, int j, int k) const { return low_O + cell * base::Vec3(i + 0.5, j + 0.5, k + 0.5); }
  /// The cell that holds a point; may lie outside the grid.
  std::array<int, 3> CellOf(const base::Vec3& p_O) const;
  base::Vec3 high_O() const { return low_O + cell * base::Vec3(size[0], size[1], size[2]); }
};

/// An immutable picture of the map for planners: two truncated Euclidean distance fields, which also tell each cell's
/// state (an occupied cell is at distance 0 from occupied ones, one that is not free at 0 from those that are not).
/// Distances are from a point to the nearest surface (cell face), never more than about 6 mm too long at cell centres
/// and interpolated between them, cut at `max_clearance`. All queries O(1), safe from any thread.
class ClearanceField {
 public:
  GridShape shape;
  double max_clearance = 1.5;             // m
  std::uint64_t revision = 0;             // of the map it was taken from
  std::vector<std::uint8_t> to_occupied;  // distance / step(), rounded down
  std::vector<std::uint8_t> to_not_free;  // the same to cells that are occupied or unknown

  double step() const { return max_clearance / 255.0; }
  CellState StateOf(std::size_t index) const {
    if (to_occupied[index] == 0) return CellState::kOccupied;
    return to_not_free[index] > 0 ? CellState::kFree : CellState::kUnknown;
  }
  /// Outside the grid: kUnknown.
  CellState State(const base::Vec3& p_O) const;
  /// Distance to the nearest occupied cell, m, in [0, max_clearance]. Outside the grid: of the nearest point inside.
  double Clearance(const base::Vec3& p_O) const;
  /// Distance to the nearest cell that is occupied or unknown (cells outside the grid do not count). Outside: 0.
  double KnownFreeClearance(const base::Vec3& p_O) const;
  /// Gradient of Clearance (unit-free; zero where truncated), for optimisers that push paths away from obstacles.
  base::Vec3 ClearanceGradient(const base::Vec3& p_O) const;
};

}  // namespace alula::stack::mapping
