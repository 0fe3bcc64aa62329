#pragma once

#include "worlds/world.h"

namespace alula::scenarios::check {

/// Where the charts of the test worlds hang: right, down, and away from who looks at them; upright, facing west.
base::Transform ChartPose();

/// The chequer board: 12 × 9 squares of 60 mm with a white border of one square. Inner corner (i, j) lies at
/// ((i − 5) side, (j − 3.5) side, 0) of the chart's frame.
struct Board {
  static constexpr int kColumns = 11, kRows = 8;  // of inner corners
  static constexpr double kSquare = 0.06;         // m
  /// Half extents with the border, m.
  static constexpr double kHalfWidth = 7.0 * kSquare, kHalfHeight = 5.5 * kSquare;
};
worlds::World BoardWorld();

/// A wall whose grey runs from black to white and back along x, once in `period` metres. Seen face on under the even
/// light of the test worlds a texture shows its own values.
worlds::World GreyWall(double period);

/// A wall of vertical stripes: black left of x = 0, white right of it, changing every `width` metres.
worlds::World StripedWall(double width);

/// A wall that is plain grey of value `left` (share of full scale) for x < 0 and `right` beyond.
worlds::World TwoGreys(double left, double right);

/// A sheet `width` metres wide of this grey (share of full scale), and `gap` metres behind it a wall a third as bright.
worlds::World SheetBeforeWall(double width, double gap, double grey);

}  // namespace alula::scenarios::check
