#include "worlds/texture_canvas.h"

#include <algorithm>
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

/// A random shape in its own coordinates, where it fits the unit circle.
bool Inside(int kind, float x, float y) {
  switch (kind) {
    case 0:
      return x * x + y * y < 1.0F;
    case 1:
      return std::max(std::abs(x), std::abs(y)) < 0.7F;
    case 2:
      return y > -0.5F && 1.732F * std::abs(x) + y < 1.0F;
    default:
      return std::abs(x) + std::abs(y) < 0.95F;
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
  const double low = std::max(config.radius_min * canvas.size, 0.8);
  const double high = std::max(config.radius_max * canvas.size, 1.01 * low);
  const double area = static_cast<double>(canvas.tone.size());
  for (double painted = 0.0; painted < config.coverage * area;) {
    const double u = random.Uniform();
    const double r = 1.0 / std::sqrt((1.0 - u) / (low * low) + u / (high * high));  // density ∝ r⁻³ on [low, high]
    painted += 2.0 * r * r;                                                         // mean area of the shapes, about
    const int kind = static_cast<int>(random.Index(4));
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double cx = random.Uniform(0.0, canvas.size);
    const double cy = random.Uniform(0.0, canvas.size);
    const double narrow = random.Uniform(0.35, 1.0);
    const auto value = static_cast<float>(random.Uniform(config.tone_min, config.tone_max));
    const auto a = static_cast<float>(std::cos(angle) / r);
    const auto b = static_cast<float>(std::sin(angle) / r);
    const auto stretch = static_cast<float>(1.0 / narrow);
    for (int y = static_cast<int>(std::floor(cy - r)); y <= static_cast<int>(cy + r); ++y) {
      const auto dy = static_cast<float>(y - cy);
      for (int x = static_cast<int>(std::floor(cx - r)); x <= static_cast<int>(cx + r); ++x) {
        const auto dx = static_cast<float>(x - cx);
        if (!Inside(kind, a * dx + b * dy, (a * dy - b * dx) * stretch)) continue;
        float& tone = canvas.At(x, y);
        tone += config.opacity * (value - tone);
      }
    }
  }
}

Cells MakeCells(int size, int columns, int rows, double jitter, base::RandomStream& random) {
  struct Point {
    float x, y;
  };
  std::vector<Point> points;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      points.push_back({static_cast<float>((c + 0.5 + jitter * random.Uniform(-0.5, 0.5)) * size / columns),
                        static_cast<float>((r + 0.5 + jitter * random.Uniform(-0.5, 0.5)) * size / rows)});
    }
  }
  Cells cells;
  cells.id.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  cells.edge.reserve(cells.id.capacity());
  const auto period = static_cast<float>(size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int column = x * columns / size;
      const int row = y * rows / size;
      float first = 1e9F;
      float second = 1e9F;
      std::uint32_t nearest = 0;
      for (int dr = -1; dr <= 1; ++dr) {
        const int r = row + dr;
        const int r_in = (r + rows) % rows;
        for (int dc = -1; dc <= 1; ++dc) {
          const int c = column + dc;
          const int c_in = (c + columns) % columns;
          const auto id = static_cast<std::uint32_t>(r_in * columns + c_in);
          const float px = points[id].x + (c < 0 ? -period : c >= columns ? period : 0.0F) - static_cast<float>(x);
          const float py = points[id].y + (r < 0 ? -period : r >= rows ? period : 0.0F) - static_cast<float>(y);
          const float d = px * px + py * py;
          if (d < first) {
            second = first;
            first = d;
            nearest = id;
          } else if (d < second) {
            second = d;
          }
        }
      }
      cells.id.push_back(nearest);
      cells.edge.push_back(0.5F * (std::sqrt(second) - std::sqrt(first)));
    }
  }
  return cells;
}

}  // namespace alula::worlds
