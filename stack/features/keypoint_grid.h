#pragma once

#include <span>
#include <vector>

#include "base/frames.h"

namespace alula::stack::features {

/// Finds the points near a pixel without looking at all of them: points sorted into square cells.
class KeypointGrid {
 public:
  /// `cell` px a side, about the radius that will be asked for. Points outside the image lie in its outermost cells.
  KeypointGrid(std::span<const base::Vec2> pixels, int width, int height, double cell = 32.0);

  /// Indices of the points within `radius` px of `pixel`, in the order of cells, then ascending.
  std::vector<int> Around(const base::Vec2& pixel, double radius) const;

 private:
  int Column(double u) const;
  int Row(double v) const;

  std::vector<base::Vec2> pixels_;
  double cell_;
  int columns_, rows_;
  std::vector<int> begin_;  // [cells + 1] into order_
  std::vector<int> order_;
};

}  // namespace alula::stack::features
