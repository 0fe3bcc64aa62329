#include "render/raster/shadowing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace alula::render::raster {
namespace {

/// A triangle as the shadow map is looked up for it: texels from the first one's centre, 1/65535 of the map's depth.
struct Lookup {
  std::array<double, 3> x, y;
  double left, right, low, high;  // of x and y
  double nearest, farthest;       // from the sun
  double at, by_x, by_y;          // distance from the sun as a plane
  double slack;                   // how much it changes within a texel along both axes
};

Lookup LookupOf(const std::array<const float*, 3>& corners) {
  Lookup t{};
  std::array<double, 3> away{};
  for (std::size_t i = 0; i < 3; ++i) {
    t.x[i] = static_cast<double>(corners[i][5]);
    t.y[i] = static_cast<double>(corners[i][6]);
    away[i] = static_cast<double>(corners[i][7]);
  }
  std::tie(t.left, t.right) = std::minmax({t.x[0], t.x[1], t.x[2]});
  std::tie(t.low, t.high) = std::minmax({t.y[0], t.y[1], t.y[2]});
  std::tie(t.nearest, t.farthest) = std::minmax({away[0], away[1], away[2]});
  const double ax = t.x[1] - t.x[0], ay = t.y[1] - t.y[0], az = away[1] - away[0];
  const double bx = t.x[2] - t.x[0], by = t.y[2] - t.y[0], bz = away[2] - away[0];
  const double area = ax * by - bx * ay;
  t.slack = INFINITY;  // seen on edge: no plane
  if (std::abs(area) < 1e-9) return t;
  t.by_x = (az * by - bz * ay) / area;
  t.by_y = (ax * bz - bx * az) / area;
  t.at = away[0] - t.by_x * t.x[0] - t.by_y * t.y[0];
  t.slack = std::abs(t.by_x) + std::abs(t.by_y);
  return t;
}

/// Whether each edge has the points within `reach` of (x, y) along both axes on its inner side: all of them (`share`
/// 1), or some of them (−1).
bool LiesInside(const Lookup& t, double x, double y, double reach, double share) {
  bool left = true, right = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double ex = t.x[j] - t.x[i], ey = t.y[j] - t.y[i];
    const double side = ex * (y - t.y[i]) - ey * (x - t.x[i]);
    const double needed = share * reach * (std::abs(ex) + std::abs(ey));
    left = left && side >= needed;
    right = right && -side >= needed;
  }
  return left || right;
}

bool MayTouch(const Lookup& t, double x, double y, double reach) { return LiesInside(t, x, y, reach, -1.0); }
bool Covers(const Lookup& t, double x, double y, double reach) { return LiesInside(t, x, y, reach, 1.0); }

constexpr double kRounding = 1.0;  // of the map's words, and of single precision on the way to them

/// Texels, inclusive.
struct Rectangle {
  int x0, y0, x1, y1;
};

/// Of those texels of a rectangle that `counts` lets count.
template <typename Counts>
Shadowing OfTexels(const Lookup& t, const ShadowMap& map, const Rectangle& r, const Counts& counts) {
  const auto by_x = static_cast<float>(t.by_x);
  const auto slack = static_cast<float>(std::min(t.slack + kRounding, 1e6));
  const auto farthest = static_cast<float>(t.farthest + kRounding);
  const auto nearest = static_cast<float>(t.nearest - kRounding);
  int texels = 0, lit = 0, dark = 0;
  for (int y = r.y0; y <= r.y1; ++y) {
    const std::uint32_t* row = map.words.data() + std::ptrdiff_t{y} * map.pitch + r.x0;
    const auto first = static_cast<float>(t.at + t.by_x * r.x0 + t.by_y * y);
    for (int i = 0; i <= r.x1 - r.x0; ++i) {  // without a branch: several texels at a time
      const float here = first + by_x * static_cast<float>(i);
      const float word = static_cast<float>(static_cast<std::int16_t>(row[i]) + 32768);
      const int count = counts(r.x0 + i, y) ? 1 : 0;
      texels += count;
      lit += count & (word >= std::min(here + slack, farthest) ? 1 : 0);
      dark += count & (word < std::max(here - slack, nearest) ? 1 : 0);
    }
    if (lit < texels && dark < texels) return Shadowing::kMixed;
  }
  return lit == texels ? Shadowing::kLit : Shadowing::kDark;
}

/// Of the look-ups in the block whose first texel is (x0, y0): they read its texels and the first ones beyond.
Shadowing OfBlock(const Lookup& t, const ShadowMap& map, int x0, int y0) {
  constexpr double kHalf = 0.5 * kShadowingBlock;
  const int x1 = x0 + kShadowingBlock, y1 = y0 + kShadowingBlock;
  if (x0 < 0 || y0 < 0 || x1 >= internal::kShadowSide || y1 >= internal::kShadowSide) return Shadowing::kMixed;
  if (Covers(t, x0 + kHalf, y0 + kHalf, kHalf)) {
    return OfTexels(t, map, {x0, y0, x1, y1}, [](int, int) { return true; });
  }
  const Rectangle near = {x0, y0, std::min(x1, static_cast<int>(std::ceil(t.right))),
                          std::min(y1, static_cast<int>(std::ceil(t.high)))};
  return OfTexels(t, map, near, [&](int x, int y) { return MayTouch(t, x, y, 1.0); });
}

/// The blocks of a triangle, row by row; true where all that the triangle touches are of one kind.
bool OfBlocks(const Lookup& t, const ShadowMap& map, const ShadowingGrid& grid, std::vector<Shadowing>& blocks) {
  std::array<bool, 3> met{};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int x0 = grid.x0 + column * kShadowingBlock, y0 = grid.y0 + row * kShadowingBlock;
      constexpr double kHalf = 0.5 * kShadowingBlock;
      const bool touched = MayTouch(t, x0 + kHalf, y0 + kHalf, kHalf + 1.0);
      const Shadowing shadowing = touched ? OfBlock(t, map, x0, y0) : Shadowing::kMixed;
      blocks.push_back(shadowing);
      if (touched) met[static_cast<std::size_t>(shadowing)] = true;
    }
  }
  return std::count(met.begin(), met.end(), true) == 1;
}

ShadowingGrid GridOver(const Lookup& t, std::size_t first) {
  const int x0 = static_cast<int>(std::floor(t.left)), y0 = static_cast<int>(std::floor(t.low));
  const auto blocks = [](int from, double to) {
    return (static_cast<int>(std::floor(to)) - from) / kShadowingBlock + 1;
  };
  return {x0, y0, blocks(x0, t.right), blocks(y0, t.high), static_cast<std::uint32_t>(first)};
}

/// Appends what it finds of one triangle.
void AddTriangle(const Lookup& t, const ShadowMap& map, ShadowingTable& table) {
  const ShadowingGrid grid = GridOver(t, table.blocks.size());
  const bool uniform = OfBlocks(t, map, grid, table.blocks);
  const bool worth_a_grid = grid.columns > 2 || grid.rows > 2;
  if (!uniform && worth_a_grid) {
    table.of_triangle.push_back(kFirstShadowingGrid + static_cast<std::uint32_t>(table.grids.size()));
    table.grids.push_back(grid);
    return;
  }
  const auto first = table.blocks.begin() + grid.first;
  const auto one = std::find_if(first, table.blocks.end(), [](Shadowing s) { return s != Shadowing::kMixed; });
  const Shadowing shadowing = uniform && one != table.blocks.end() ? *one : Shadowing::kMixed;
  table.of_triangle.push_back(static_cast<std::uint32_t>(shadowing));
  table.blocks.resize(grid.first);
}

}  // namespace

ShadowingTable FindShadowing(const internal::SceneGeometry& scene, const std::vector<float>& attributes,
                             const ShadowMap& map) {
  ShadowingTable table;
  const std::size_t static_vertices = attributes.size() / kAttributes;
  for (std::size_t index = 0; index < scene.indices.size(); index += 3) {
    const std::uint32_t* corner = scene.indices.data() + index;
    if (*std::max_element(corner, corner + 3) >= static_vertices) {
      table.of_triangle.push_back(static_cast<std::uint32_t>(Shadowing::kMixed));
      continue;
    }
    const auto attributes_of = [&](std::size_t i) { return attributes.data() + std::size_t{corner[i]} * kAttributes; };
    const std::array<const float*, 3> corners = {attributes_of(0), attributes_of(1), attributes_of(2)};
    const auto faces_sun = [](const float* of_corner) { return of_corner[4] > 0.0F; };
    if (std::any_of(corners.begin(), corners.end(), faces_sun)) {
      AddTriangle(LookupOf(corners), map, table);
    } else {
      table.of_triangle.push_back(static_cast<std::uint32_t>(Shadowing::kDark));
    }
  }
  return table;
}

}  // namespace alula::render::raster
