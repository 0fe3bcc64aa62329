#include "stack/features/internal/quadtree.h"

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>

namespace alula::stack::features::internal {
namespace {

struct Leaf {
  double x0 = 0, y0 = 0, side = 0;
  std::size_t first = 0, last = 0;  // its corners in the common list
  int depth = 0;
};

using Iterator = std::vector<LevelCorner>::iterator;

/// Sorts a leaf's corners into its quarters, in place; empty quarters are left out.
std::vector<Leaf> Divide(const Leaf& leaf, std::vector<LevelCorner>& corners) {
  const double half = 0.5 * leaf.side, xm = leaf.x0 + half, ym = leaf.y0 + half;
  const auto begin = corners.begin();
  const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
  const auto above = [ym](const LevelCorner& c) { return c.y < ym; };
  const auto left = [xm](const LevelCorner& c) { return c.x < xm; };
  const Iterator middle = std::stable_partition(at(leaf.first), at(leaf.last), above);
  const Iterator upper = std::stable_partition(at(leaf.first), middle, left);
  const Iterator lower = std::stable_partition(middle, at(leaf.last), left);
  const std::array<Iterator, 5> cuts{at(leaf.first), upper, middle, lower, at(leaf.last)};
  std::vector<Leaf> quarters;
  for (std::size_t q = 0; q < 4; ++q) {
    if (cuts[q] == cuts[q + 1]) continue;
    quarters.push_back({q % 2 == 0 ? leaf.x0 : xm, q < 2 ? leaf.y0 : ym, half,
                        static_cast<std::size_t>(cuts[q] - begin), static_cast<std::size_t>(cuts[q + 1] - begin),
                        leaf.depth + 1});
  }
  return quarters;
}

std::vector<Leaf> Roots(std::vector<LevelCorner>& corners, int width, int height) {
  const int side = std::min(width, height);
  std::vector<Leaf> roots;
  // Strips of squares along the longer side; the last one reaches beyond the image.
  std::size_t first = 0;
  for (int at = 0; at < std::max(width, height); at += side) {
    const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = std::stable_partition(
        begin, corners.end(), [&](const LevelCorner& c) { return (width >= height ? c.x : c.y) < at + side; });
    const std::size_t last = static_cast<std::size_t>(end - corners.begin());
    if (last > first) {
      roots.push_back({width >= height ? static_cast<double>(at) : 0.0, width >= height ? 0.0 : static_cast<double>(at),
                       static_cast<double>(side), first, last, 0});
    }
    first = last;
  }
  return roots;
}

}  // namespace

std::vector<LevelCorner> Distribute(std::span<const LevelCorner> all, int width, int height, int wanted, int smallest) {
  std::vector<LevelCorner> corners(all.begin(), all.end());
  std::vector<Leaf> leaves = Roots(corners, width, height);
  const auto later = [&leaves](std::size_t a, std::size_t b) {
    const auto key = [&leaves](std::size_t i) {
      const Leaf& l = leaves[i];
      return std::tuple(-l.depth, l.last - l.first);
    };
    return key(a) != key(b) ? key(a) < key(b) : a > b;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(later)> queue(later);
  const auto offer = [&](std::size_t i) {
    if (leaves[i].last - leaves[i].first > 1 && leaves[i].side > smallest) queue.push(i);
  };
  for (std::size_t i = 0; i < leaves.size(); ++i) offer(i);
  while (!queue.empty() && static_cast<int>(leaves.size()) < wanted) {
    const std::size_t i = queue.top();
    queue.pop();
    const std::vector<Leaf> quarters = Divide(leaves[i], corners);
    leaves[i] = quarters.front();
    offer(i);
    for (std::size_t q = 1; q < quarters.size(); ++q) {
      leaves.push_back(quarters[q]);
      offer(leaves.size() - 1);
    }
  }
  std::vector<LevelCorner> kept;
  for (const Leaf& leaf : leaves) {
    kept.push_back(
        *std::max_element(corners.begin() + static_cast<std::ptrdiff_t>(leaf.first),
                          corners.begin() + static_cast<std::ptrdiff_t>(leaf.last),
                          [](const LevelCorner& a, const LevelCorner& b) { return a.response < b.response; }));
  }
  const auto weaker = [](const LevelCorner& a, const LevelCorner& b) { return a.response > b.response; };
  if (static_cast<int>(kept.size()) > wanted) {  // the last division may give three too many, the roots more
    std::stable_sort(kept.begin(), kept.end(), weaker);
    kept.resize(static_cast<std::size_t>(std::max(0, wanted)));
  }
  std::sort(kept.begin(), kept.end(),
            [](const LevelCorner& a, const LevelCorner& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
  return kept;
}

}  // namespace alula::stack::features::internal
