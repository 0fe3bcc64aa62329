#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stack/mapping/clearance_field.h"

namespace alula::stack::mapping::internal {

/// A box of cells, both ends included; empty while low > high.
struct CellBox {
  std::array<int, 3> low{1 << 30, 1 << 30, 1 << 30};
  std::array<int, 3> high{-1, -1, -1};

  bool empty() const { return low[0] > high[0]; }
  void Add(int i, int j, int k) {
    const std::array<int, 3> c{i, j, k};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = c[axis] < low[axis] ? c[axis] : low[axis];
      high[axis] = c[axis] > high[axis] ? c[axis] : high[axis];
    }
  }
  /// Grown by `cells` on all sides and cut to the grid.
  CellBox Grown(int cells, const std::array<int, 3>& size) const;
  int Length(int axis) const { return high[axis] - low[axis] + 1; }
};

/// Truncated exact Euclidean distance from cell centres to the faces of obstacle cells, brought up to date after the
/// cells of a box changed: Σ over the axes of max(0, |Δ| − ½)² is separable, so three passes of minima over a window of
/// ± the truncation do it (Felzenszwalb and Huttenlocher 2012, section 2, with a window in place of the envelope).
class DistanceTransform {
 public:
  /// Distances are cut at `max_distance` (m) and stored as floor(255·d / max_distance).
  DistanceTransform(const GridShape& shape, double max_distance);

  /// `obstacle(state)` tells which cells are obstacles; `out` holds the distances of the whole grid and is correct
  /// again afterwards if only cells of `changed` changed since it was.
  template <typename Obstacle>
  void Update(const std::vector<CellState>& state, const CellBox& changed, Obstacle obstacle,
              std::vector<std::uint8_t>& out);

  int reach() const { return reach_; }

 private:
  void Columns(const CellBox& box);
  void AcrossRows(const CellBox& from, const CellBox& to);
  void AcrossSlices(const CellBox& from, const CellBox& to, std::vector<std::uint8_t>& out);

  GridShape shape_;
  int reach_ = 0;                          // cells
  std::vector<std::int16_t> along_;        // squared distance along one axis by offset, (half cells)²
  std::vector<std::uint8_t> quantised_;    // by squared distance, (half cells)²
  std::vector<std::uint8_t> is_obstacle_;  // scratch: of the box read
  std::vector<std::int16_t> first_;        // after the pass along k
  std::vector<std::uint8_t> any_first_;    // whether a column of first_ is finite anywhere
  std::vector<std::int16_t> second_;       // after the pass along j
  std::vector<std::uint8_t> any_second_;
  std::vector<std::int16_t> slice_;
};

template <typename Obstacle>
void DistanceTransform::Update(const std::vector<CellState>& state, const CellBox& changed, Obstacle obstacle,
                               std::vector<std::uint8_t>& out) {
  if (changed.empty()) return;
  const CellBox to = changed.Grown(reach_, shape_.size);
  const CellBox from = to.Grown(reach_, shape_.size);
  const std::size_t column = static_cast<std::size_t>(from.Length(2));
  is_obstacle_.resize(column * from.Length(0) * from.Length(1));
  std::size_t at = 0;
  for (int i = from.low[0]; i <= from.high[0]; ++i) {
    for (int j = from.low[1]; j <= from.high[1]; ++j) {
      const CellState* cell = state.data() + shape_.Index(i, j, from.low[2]);
      for (std::size_t k = 0; k < column; ++k) is_obstacle_[at++] = obstacle(cell[k]);
    }
  }
  Columns(from);
  CellBox rows = from;
  rows.low[1] = to.low[1];
  rows.high[1] = to.high[1];
  AcrossRows(from, rows);
  AcrossSlices(rows, to, out);
}

}  // namespace alula::stack::mapping::internal
