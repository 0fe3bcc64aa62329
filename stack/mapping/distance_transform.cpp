#include "stack/mapping/internal/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace alula::stack::mapping::internal {

namespace {

constexpr std::int16_t kFar = 16000;  // above any squared distance that is kept, and twice it still fits

/// target[k] = min(target[k], source[k] + offset); the largest that is left.
std::int16_t LowerTo(std::int16_t* target, const std::int16_t* source, std::int16_t offset, int n) {
  std::int16_t largest = 0;
  for (int k = 0; k < n; ++k) {
    const std::int16_t candidate = static_cast<std::int16_t>(source[k] + offset);
    target[k] = candidate < target[k] ? candidate : target[k];
    largest = target[k] > largest ? target[k] : largest;
  }
  return largest;
}

/// target = the minimum over the rows about `centre` of row + offset²: nearest first, until no farther row can lower
/// anything. `row(s)` is null where there is no obstacle; false when all were.
template <typename Row>
bool LowerToNeighbours(const std::vector<std::int16_t>& along, int centre, int count, Row row, int n,
                       std::int16_t* target) {
  const int reach = static_cast<int>(along.size()) - 1;
  std::int16_t largest = kFar;
  bool any = false;
  const auto lower_to = [&](int s, int d) {
    const std::int16_t* source = s >= 0 && s < count ? row(s) : nullptr;
    if (source == nullptr) return;
    largest = LowerTo(target, source, along[d], n);
    any = true;
  };
  lower_to(centre, 0);
  for (int d = 1; d <= reach && along[d] < largest; ++d) {
    lower_to(centre - d, d);
    lower_to(centre + d, d);
  }
  return any;
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
  const std::size_t length = static_cast<std::size_t>(n);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::uint8_t* obstacle = is_obstacle_.data() + c * length;
    if (std::memchr(obstacle, 1, length) == nullptr) continue;
    any_first_[c] = 1;
    std::int16_t* row = first_.data() + c * length;
    if (std::memchr(obstacle, 0, length) == nullptr) {
      std::fill(row, row + length, std::int16_t{0});
      continue;
    }
    int since = reach_ + 1;
    for (int k = 0; k < n; ++k) {
      since = obstacle[k] ? 0 : since + 1;
      row[k] = since <= reach_ ? along_[since] : kFar;
    }
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
  any_second_.resize(static_cast<std::size_t>(from.Length(0)) * rows_to);
  for (int i = 0; i < from.Length(0); ++i) {
    const auto row = [&](int j) -> const std::int16_t* {
      const std::size_t at = static_cast<std::size_t>(i) * rows_from + j;
      return any_first_[at] ? first_.data() + at * n : nullptr;
    };
    for (int t = 0; t < rows_to; ++t) {
      const std::size_t at = static_cast<std::size_t>(i) * rows_to + t;
      any_second_[at] = LowerToNeighbours(along_, t + shift, rows_from, row, n, second_.data() + at * n);
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
    for (int j = 0; j < rows; ++j) {
      const auto row = [&](int s) -> const std::int16_t* {
        const std::size_t at = static_cast<std::size_t>(s) * rows + j;
        return any_second_[at] ? second_.data() + at * n : nullptr;
      };
      std::fill(slice_.begin(), slice_.end(), kFar);
      LowerToNeighbours(along_, i + shift, from.Length(0), row, n, slice_.data());
      std::uint8_t* target = out.data() + shape_.Index(to.low[0] + i, to.low[1] + j, to.low[2]);
      for (int k = 0; k < to.Length(2); ++k) {
        const std::int16_t squared = slice_[skip + k];
        target[k] = static_cast<std::size_t>(squared) < quantised_.size() ? quantised_[squared] : 255;
      }
    }
  }
}

}  // namespace alula::stack::mapping::internal
