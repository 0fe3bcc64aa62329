#include "stack/features/keypoint_grid.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::features {

using base::Vec2;

KeypointGrid::KeypointGrid(std::span<const Vec2> pixels, int width, int height, double cell)
    : pixels_(pixels.begin(), pixels.end()),
      cell_(cell),
      columns_(std::max(1, static_cast<int>(std::ceil(width / cell)))),
      rows_(std::max(1, static_cast<int>(std::ceil(height / cell)))),
      begin_(static_cast<std::size_t>(columns_ * rows_) + 1, 0),
      order_(pixels.size()) {
  // Counting sort: sizes, then where each cell begins, then the points in their order.
  std::vector<std::size_t> cells;
  cells.reserve(pixels.size());
  for (const Vec2& p : pixels_) {
    cells.push_back(static_cast<std::size_t>(Row(p.y()) * columns_ + Column(p.x())));
    ++begin_[cells.back() + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    order_[static_cast<std::size_t>(next[cells[i]]++)] = static_cast<int>(i);
  }
}

int KeypointGrid::Column(double u) const {
  return static_cast<int>(std::clamp(std::floor(u / cell_), 0.0, static_cast<double>(columns_ - 1)));
}
int KeypointGrid::Row(double v) const {
  return static_cast<int>(std::clamp(std::floor(v / cell_), 0.0, static_cast<double>(rows_ - 1)));
}

std::vector<int> KeypointGrid::Around(const Vec2& pixel, double radius) const {
  std::vector<int> found;
  for (int r = Row(pixel.y() - radius); r <= Row(pixel.y() + radius); ++r) {
    const std::size_t row = static_cast<std::size_t>(r * columns_);
    const int first = begin_[row + static_cast<std::size_t>(Column(pixel.x() - radius))];
    const int last = begin_[row + static_cast<std::size_t>(Column(pixel.x() + radius)) + 1];
    for (int k = first; k < last; ++k) {
      const int i = order_[static_cast<std::size_t>(k)];
      if ((pixels_[static_cast<std::size_t>(i)] - pixel).squaredNorm() <= radius * radius) found.push_back(i);
    }
  }
  return found;
}

}  // namespace alula::stack::features
