#include "stack/mapping/internal/distance_transform.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::mapping::internal {

namespace {

constexpr std::int16_t kFar = 16000;  // above any squared distance that is kept, and twice it still fits

/// target[k] = min(target[k], source[k] + offset).
void LowerTo(std::int16_t* target, const std::int16_t* source, std::int16_t offset, int n) {
  for (int k = 0; k < n; ++k) {
    const std::int16_t candidate = static_cast<std::int16_t>(source[k] + offset);
    target[k] = candidate < target[k] ? candidate : target[k];
  }
}

}  // namespace

CellBox CellBox::Grown(int cells, const std::array<int, 3>& size) const {
  CellBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::max(low[axis] - cells, 0);
    box.high[axis] = std::min(high[axis] + cells, size[axis] - 1);
  }
  return box;
}

DistanceTransform::DistanceTransform(const GridShape& shape, double max_distance) : shape_(shape) {
  // |Δ| − ½ < max_distance / cell; at most 35 cells keep three squares below kFar.
  reach_ = std::min(35, static_cast<int>(std::ceil(max_distance / shape.cell + 0.5)));
  for (int d = 0; d <= reach_; ++d) {
    const int half_cells = std::max(0, 2 * d - 1);
    along_.push_back(static_cast<std::int16_t>(half_cells * half_cells));
  }
  quantised_.resize(static_cast<std::size_t>(3 * along_.back()) + 1);
  for (std::size_t s = 0; s < quantised_.size(); ++s) {
    const double distance = 0.5 * shape.cell * std::sqrt(static_cast<double>(s));
    quantised_[s] = static_cast<std::uint8_t>(std::min(255.0, std::floor(255.0 * distance / max_distance + 1e-9)));
  }
}

void DistanceTransform::Columns(const CellBox& box) {
  const int n = box.Length(2);
  const std::size_t columns = static_cast<std::size_t>(box.Length(0)) * box.Length(1);
  first_.resize(columns * n);
  any_first_.assign(columns, 0);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::uint8_t* obstacle = is_obstacle_.data() + c * n;
    std::int16_t* row = first_.data() + c * n;
    int since = reach_ + 1;
    for (int k = 0; k < n; ++k) {
      since = obstacle[k] ? 0 : since + 1;
      row[k] = since <= reach_ ? along_[since] : kFar;
    }
    if (since > n + reach_) continue;  // no obstacle in the column
    any_first_[c] = 1;
    since = reach_ + 1;
    for (int k = n - 1; k >= 0; --k) {
      since = obstacle[k] ? 0 : since + 1;
      if (since <= reach_) row[k] = std::min(row[k], along_[since]);
    }
  }
}

void DistanceTransform::AcrossRows(const CellBox& from, const CellBox& to) {
  const int n = from.Length(2);
  const int rows_from = from.Length(1);
  const int rows_to = to.Length(1);
  const int shift = to.low[1] - from.low[1];
  second_.assign(static_cast<std::size_t>(from.Length(0)) * rows_to * n, kFar);
  any_second_.assign(static_cast<std::size_t>(from.Length(0)) * rows_to, 0);
  for (int i = 0; i < from.Length(0); ++i) {
    for (int j = 0; j < rows_from; ++j) {
      const std::size_t source = static_cast<std::size_t>(i) * rows_from + j;
      if (!any_first_[source]) continue;
      const int last = std::min(rows_to - 1, j - shift + reach_);
      for (int t = std::max(0, j - shift - reach_); t <= last; ++t) {
        const std::size_t target = static_cast<std::size_t>(i) * rows_to + t;
        any_second_[target] = 1;
        LowerTo(second_.data() + target * n, first_.data() + source * n, along_[std::abs(t + shift - j)], n);
      }
    }
  }
}

void DistanceTransform::AcrossSlices(const CellBox& from, const CellBox& to, std::vector<std::uint8_t>& out) {
  const int n = from.Length(2);
  const int rows = from.Length(1);
  const int shift = to.low[0] - from.low[0];
  const int skip = to.low[2] - from.low[2];
  slice_.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < to.Length(0); ++i) {
    const int last = std::min(from.Length(0) - 1, i + shift + reach_);
    for (int j = 0; j < rows; ++j) {
      std::fill(slice_.begin(), slice_.end(), kFar);
      for (int s = std::max(0, i + shift - reach_); s <= last; ++s) {
        const std::size_t source = static_cast<std::size_t>(s) * rows + j;
        if (!any_second_[source]) continue;
        LowerTo(slice_.data(), second_.data() + source * n, along_[std::abs(s - shift - i)], n);
      }
      std::uint8_t* target = out.data() + shape_.Index(to.low[0] + i, to.low[1] + j, to.low[2]);
      for (int k = 0; k < to.Length(2); ++k) {
        const std::int16_t squared = slice_[skip + k];
        target[k] = static_cast<std::size_t>(squared) < quantised_.size() ? quantised_[squared] : 255;
      }
    }
  }
}

}  // namespace alula::stack::mapping::internal
