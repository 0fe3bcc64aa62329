#include "stack/features/internal/level_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/features2d.hpp>

namespace alula::stack::features::internal {
namespace {

constexpr int kFastRadius = 3;  // px of the circle

/// P1's saliency: contrast of a pixel to the 16 of its circle.
float Saliency(const cv::Mat& image, int x, int y) {
  constexpr std::array<std::array<int, 2>, 16> kCircle{{{0, -3},
                                                        {1, -3},
                                                        {2, -2},
                                                        {3, -1},
                                                        {3, 0},
                                                        {3, 1},
                                                        {2, 2},
                                                        {1, 3},
                                                        {0, 3},
                                                        {-1, 3},
                                                        {-2, 2},
                                                        {-3, 1},
                                                        {-3, 0},
                                                        {-3, -1},
                                                        {-2, -2},
                                                        {-1, -3}}};
  const int centre = image.at<std::uint8_t>(y, x);
  int sum = 0;
  for (const auto& [u, v] : kCircle) sum += std::abs(centre - image.at<std::uint8_t>(y + v, x + u));
  return static_cast<float>(sum);
}

/// Corners inside `box`, which may begin at the border.
void AddCorners(const cv::Mat& level, const cv::Rect& box, int threshold, std::vector<cv::KeyPoint>& found,
                std::vector<LevelCorner>& corners) {
  const cv::Rect seen(box.x - kFastRadius, box.y - kFastRadius, box.width + 2 * kFastRadius,
                      box.height + 2 * kFastRadius);
  cv::FAST(level(seen), found, threshold, true);
  for (const cv::KeyPoint& k : found) {
    corners.push_back({static_cast<int>(k.pt.x) + seen.x, static_cast<int>(k.pt.y) + seen.y, k.response});
  }
}

}  // namespace

std::vector<LevelCorner> FindLevelCorners(const cv::Mat& level, const OrbConfig& config) {
  const cv::Rect inside(kOrbBorder, kOrbBorder, level.cols - 2 * kOrbBorder, level.rows - 2 * kOrbBorder);
  std::vector<LevelCorner> corners;
  if (inside.width <= 0 || inside.height <= 0) return corners;
  std::vector<cv::KeyPoint> found;
  AddCorners(level, inside, config.threshold, found, corners);

  const int columns = (inside.width + config.cell - 1) / config.cell;
  const int rows = (inside.height + config.cell - 1) / config.cell;
  std::vector<bool> empty(static_cast<std::size_t>(columns * rows), true);
  for (const LevelCorner& c : corners) {
    empty[static_cast<std::size_t>((c.y - inside.y) / config.cell * columns + (c.x - inside.x) / config.cell)] = false;
  }
  if (config.low_threshold < config.threshold) {
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {  // neighbours that are empty as well are looked at together
        const int first = c;
        while (c < columns && empty[static_cast<std::size_t>(r * columns + c)]) ++c;
        if (c == first) continue;
        const cv::Rect run(inside.x + first * config.cell, inside.y + r * config.cell, (c - first) * config.cell,
                           config.cell);
        AddCorners(level, run & inside, config.low_threshold, found, corners);
      }
    }
  }
  if (config.ranking == OrbRanking::kSaliency) {
    for (LevelCorner& c : corners) c.response = Saliency(level, c.x, c.y);
  }
  return corners;
}

base::Vec2 RefineCorner(const cv::Mat& level, int x, int y) {
  constexpr int kHalf = 3;
  constexpr double kMinShape = 0.05;  // smaller by larger eigenvalue: below, it is an edge
  int xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    const std::uint8_t* above = level.ptr<std::uint8_t>(y + v - 1) + x;
    const std::uint8_t* row = level.ptr<std::uint8_t>(y + v) + x;
    const std::uint8_t* below = level.ptr<std::uint8_t>(y + v + 1) + x;
    for (int u = -kHalf; u <= kHalf; ++u) {
      const int gx = row[u + 1] - row[u - 1], gy = below[u] - above[u];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
      bx += gx * (gx * u + gy * v);
      by += gy * (gx * u + gy * v);
    }
  }
  const base::Vec2 whole(x, y);
  const double determinant = static_cast<double>(xx) * yy - static_cast<double>(xy) * xy;
  const double trace = static_cast<double>(xx) + yy;
  if (determinant < kMinShape * trace * trace / 4) return whole;
  const base::Vec2 step((static_cast<double>(yy) * bx - static_cast<double>(xy) * by) / determinant,
                        (static_cast<double>(xx) * by - static_cast<double>(xy) * bx) / determinant);
  return step.norm() <= 1.0 ? base::Vec2(whole + step) : whole;
}

}  // namespace alula::stack::features::internal
