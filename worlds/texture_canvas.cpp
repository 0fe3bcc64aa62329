#include "worlds/texture_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace alula::worlds {
namespace {

/// SplitMix64's finaliser as a counter-based generator: a texture needs millions of numbers and little quality.
float SignedHash(std::uint64_t key, std::uint64_t counter) {
  std::uint64_t z = key + counter * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<float>(z >> 40) * (2.0F / 16777216.0F) - 1.0F;
}

/// Twice the size, with the quadratic B-spline's weights (3/4, 1/4).
Canvas Doubled(const Canvas& in) {
  const int n = in.size;
  std::vector<float> wide(static_cast<std::size_t>(2 * n) * static_cast<std::size_t>(n));
  for (int y = 0; y < n; ++y) {
    float* row = wide.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(2 * n);
    for (int x = 0; x < n; ++x) {
      const float c = 0.75F * in.At(x, y);
      row[2 * x] = c + 0.25F * in.At(x - 1, y);
      row[2 * x + 1] = c + 0.25F * in.At(x + 1, y);
    }
  }
  Canvas out(2 * n);
  const auto row_of = [&](int y) {
    return wide.data() + static_cast<std::size_t>((y + n) & (n - 1)) * static_cast<std::size_t>(2 * n);
  };
  for (int y = 0; y < n; ++y) {
    const float* here = row_of(y);
    const float* below = row_of(y - 1);
    const float* above = row_of(y + 1);
    float* even = &out.At(0, 2 * y);
    float* odd = &out.At(0, 2 * y + 1);
    for (int x = 0; x < 2 * n; ++x) {
      even[x] = 0.75F * here[x] + 0.25F * below[x];
      odd[x] = 0.75F * here[x] + 0.25F * above[x];
    }
  }
  return out;
}

/// The shapes in their own coordinates, where each fits the unit circle.
struct Disc {
  static bool Holds(float x, float y) { return x * x + y * y < 1.0F; }
};
struct Square {
  static bool Holds(float x, float y) { return std::max(std::abs(x), std::abs(y)) < 0.7F; }
};
struct Triangle {
  static bool Holds(float x, float y) { return y > -0.5F && 1.732F * std::abs(x) + y < 1.0F; }
};
struct Diamond {
  static bool Holds(float x, float y) { return std::abs(x) + std::abs(y) < 0.95F; }
};

struct Leaf {
  double x, y, radius;  // texels
  float a, b;           // cosine and sine of its turn, over its radius
  float stretch;        // how much narrower than long it is
  float tone;
  float opacity;
};

template <typename Form>
void PaintLeaf(Canvas& canvas, const Leaf& leaf) {
  const int x_first = static_cast<int>(std::floor(leaf.x - leaf.radius));
  const int x_last = static_cast<int>(leaf.x + leaf.radius);
  for (int y = static_cast<int>(std::floor(leaf.y - leaf.radius)); y <= static_cast<int>(leaf.y + leaf.radius); ++y) {
    const auto dy = static_cast<float>(y - leaf.y);
    float* row = &canvas.At(0, y);
    for (int x = x_first; x <= x_last; ++x) {
      const auto dx = static_cast<float>(x - leaf.x);
      if (!Form::Holds(leaf.a * dx + leaf.b * dy, (leaf.a * dy - leaf.b * dx) * leaf.stretch)) continue;
      float& tone = row[x & (canvas.size - 1)];
      tone += leaf.opacity * (leaf.tone - tone);
    }
  }
}

}  // namespace

Canvas PinkNoise(int size, base::RandomStream& random) {
  const std::uint64_t key = random.Bits();
  std::uint64_t counter = 0;
  Canvas noise(4, 0.0F);
  for (;;) {
    for (float& v : noise.tone) v += SignedHash(key, counter++);
    if (noise.size >= size) break;
    noise = Doubled(noise);
  }
  double sum = 0.0;
  double squares = 0.0;
  for (const float v : noise.tone) {
    sum += v;
    squares += static_cast<double>(v) * v;
  }
  const double mean = sum / static_cast<double>(noise.tone.size());
  const double deviation = std::sqrt(squares / static_cast<double>(noise.tone.size()) - mean * mean);
  for (float& v : noise.tone) v = (v - static_cast<float>(mean)) / static_cast<float>(deviation);
  return noise;
}

void PaintLeaves(Canvas& canvas, const LeavesConfig& config, base::RandomStream& random) {
  constexpr double kUsualWidth = 0.675;  // mean width over length for which the mean area is 2 r²
  const double low = std::max(config.radius_min * canvas.size, 0.8);
  const double high = std::max(config.radius_max * canvas.size, 1.01 * low);
  const double area = static_cast<double>(canvas.tone.size());
  for (double painted = 0.0; painted < config.coverage * area;) {
    const double u = random.Uniform();
    const double r = 1.0 / std::sqrt((1.0 - u) / (low * low) + u / (high * high));  // density ∝ r⁻³ on [low, high]
    // Mean area of the shapes, about.
    painted += 2.0 * r * r * (0.5 * (config.narrowest + config.widest) / kUsualWidth);
    const std::uint64_t form = random.Index(4);
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    Leaf leaf{};
    leaf.x = random.Uniform(0.0, canvas.size);
    leaf.y = random.Uniform(0.0, canvas.size);
    leaf.radius = r;
    leaf.a = static_cast<float>(std::cos(angle) / r);
    leaf.b = static_cast<float>(std::sin(angle) / r);
    leaf.stretch = static_cast<float>(1.0 / random.Uniform(config.narrowest, config.widest));
    leaf.tone = static_cast<float>(random.Uniform(config.tone_min, config.tone_max));
    leaf.opacity = config.opacity;
    if (form == 0) PaintLeaf<Disc>(canvas, leaf);
    if (form == 1) PaintLeaf<Square>(canvas, leaf);
    if (form == 2) PaintLeaf<Triangle>(canvas, leaf);
    if (form == 3) PaintLeaf<Diamond>(canvas, leaf);
  }
}

namespace {

struct CellPoint {
  float x, y;
  std::uint32_t id;
};

/// The nine points around grid cell (column, row), moved by whole periods to where they are nearest.
std::array<CellPoint, 9> Neighbours(const std::vector<CellPoint>& points, int column, int row, int columns, int rows,
                                    float period) {
  std::array<CellPoint, 9> near{};
  for (int i = 0; i < 9; ++i) {
    const int c = column + i % 3 - 1;
    const int r = row + i / 3 - 1;
    CellPoint p = points[static_cast<std::size_t>((r + rows) % rows * columns + (c + columns) % columns)];
    p.x += c < 0 ? -period : c >= columns ? period : 0.0F;
    p.y += r < 0 ? -period : r >= rows ? period : 0.0F;
    near[static_cast<std::size_t>(i)] = p;
  }
  return near;
}

}  // namespace

Cells MakeCells(int size, int columns, int rows, double jitter, base::RandomStream& random) {
  std::vector<CellPoint> points;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto x = static_cast<float>((c + 0.5 + jitter * random.Uniform(-0.5, 0.5)) * size / columns);
      const auto y = static_cast<float>((r + 0.5 + jitter * random.Uniform(-0.5, 0.5)) * size / rows);
      points.push_back({x, y, static_cast<std::uint32_t>(points.size())});
    }
  }
  Cells cells;
  cells.id.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  cells.edge.reserve(cells.id.capacity());
  for (int y = 0; y < size; ++y) {
    for (int column = 0; column < columns; ++column) {
      const auto near = Neighbours(points, column, y * rows / size, columns, rows, static_cast<float>(size));
      const int end = ((column + 1) * size + columns - 1) / columns;
      for (int x = (column * size + columns - 1) / columns; x < end; ++x) {
        float first = 1e9F;
        float second = 1e9F;
        std::uint32_t nearest = 0;
        for (const CellPoint& p : near) {
          const float dx = p.x - static_cast<float>(x);
          const float dy = p.y - static_cast<float>(y);
          const float d = dx * dx + dy * dy;
          second = std::min(second, std::max(first, d));
          nearest = d < first ? p.id : nearest;
          first = std::min(first, d);
        }
        cells.id.push_back(nearest);
        cells.edge.push_back(0.5F * (std::sqrt(second) - std::sqrt(first)));
      }
    }
  }
  return cells;
}

}  // namespace alula::worlds
