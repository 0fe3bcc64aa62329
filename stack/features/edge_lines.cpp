#include "stack/features/internal/edge_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace alula::stack::features {
namespace {

using base::Vec2;

constexpr double kAligned = 1.0 / 8.0;  // chance that a gradient lies within 22.5° of one given
constexpr double kCosine = 0.92387953;  // of 22.5°
constexpr int kScan = 2;                // px between rows and columns on which anchors are looked for
constexpr int kStray = 4;               // px in a row that may leave a line before it ends

/// The gradient of a smoothed image: magnitude |gx| + |gy| (Sobel, 8 × grey levels a px) and whether the edge through a
/// pixel runs up and down.
struct Gradient {
  int width = 0, height = 0;
  std::vector<std::int16_t> x, y, magnitude;

  std::size_t At(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  bool Upright(std::size_t i) const { return std::abs(x[i]) >= std::abs(y[i]); }
};

Gradient GradientOf(const cv::Mat& image) {
  cv::Mat smooth, gx, gy;
  cv::GaussianBlur(image, smooth, {5, 5}, 1.0);
  cv::Sobel(smooth, gx, CV_16S, 1, 0);
  cv::Sobel(smooth, gy, CV_16S, 0, 1);
  Gradient g;
  g.width = image.cols;
  g.height = image.rows;
  const std::size_t size = static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height);
  g.x.assign(gx.ptr<std::int16_t>(), gx.ptr<std::int16_t>() + size);
  g.y.assign(gy.ptr<std::int16_t>(), gy.ptr<std::int16_t>() + size);
  g.magnitude.resize(size);
  for (std::size_t i = 0; i < size; ++i)
    g.magnitude[i] = static_cast<std::int16_t>(std::abs(g.x[i]) + std::abs(g.y[i]));
  return g;
}

struct Pixel {
  int u = 0, v = 0;
};

/// Anchors, those of the steepest gradient first.
std::vector<Pixel> AnchorsOf(const Gradient& g, int least, int excess) {
  std::vector<std::pair<int, Pixel>> found;
  for (int v = 2; v < g.height - 2; ++v) {
    const int step = v % kScan == 0 ? 1 : kScan;
    for (int u = 2; u < g.width - 2; u += step) {
      const std::size_t i = g.At(u, v);
      const int m = g.magnitude[i];
      if (m < least) continue;
      const std::size_t across = g.Upright(i) ? 1 : static_cast<std::size_t>(g.width);
      if (m - g.magnitude[i - across] >= excess && m - g.magnitude[i + across] >= excess) found.push_back({m, {u, v}});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Pixel> anchors;
  for (const auto& [m, pixel] : found) anchors.push_back(pixel);
  return anchors;
}

/// Walks along the ridge from `from` in the direction (du, dv), one of the four; what it passes is taken.
void Walk(const Gradient& g, int least, Pixel at, int du, int dv, std::vector<std::uint8_t>& taken,
          std::vector<Pixel>& chain) {
  int trend_u = du, trend_v = dv;  // the last steps sideways: near 45° an edge changes its kind every few pixels
  while (true) {
    // Of the three neighbours ahead, the steepest.
    Pixel best;
    int most = -1;
    for (int side = -1; side <= 1; ++side) {
      const Pixel next{at.u + (du != 0 ? du : side), at.v + (dv != 0 ? dv : side)};
      const int m = g.magnitude[g.At(next.u, next.v)];
      if (m > most) {
        most = m;
        best = next;
      }
    }
    if (best.u < 2 || best.v < 2 || best.u >= g.width - 2 || best.v >= g.height - 2) return;
    const std::size_t i = g.At(best.u, best.v);
    if (most < least || taken[i] != 0) return;
    const int su = best.u - at.u, sv = best.v - at.v;
    taken[i] = 1;
    chain.push_back(best);
    at = best;
    trend_u = su != 0 ? su : trend_u;
    trend_v = sv != 0 ? sv : trend_v;
    // The edge turns between up-and-down and across: it goes on to the side that it came towards.
    const bool upright = g.Upright(i);
    if (upright && du != 0) {
      du = 0;
      dv = trend_v != 0 ? trend_v : (g.magnitude[g.At(at.u, at.v + 1)] >= g.magnitude[g.At(at.u, at.v - 1)] ? 1 : -1);
    } else if (!upright && dv != 0) {
      dv = 0;
      du = trend_u != 0 ? trend_u : (g.magnitude[g.At(at.u + 1, at.v)] >= g.magnitude[g.At(at.u - 1, at.v)] ? 1 : -1);
    }
  }
}

/// Where between pixels the ridge lies: the top of a parabola through three magnitudes across the edge.
Vec2 Refined(const Gradient& g, const Pixel& p) {
  const std::size_t i = g.At(p.u, p.v);
  const bool upright = g.Upright(i);
  const std::size_t across = upright ? 1 : static_cast<std::size_t>(g.width);
  const double low = g.magnitude[i - across], here = g.magnitude[i], high = g.magnitude[i + across];
  const double bend = low - 2.0 * here + high;
  const double offset = bend < 0.0 ? std::clamp(0.5 * (low - high) / bend, -0.5, 0.5) : 0.0;
  return {p.u + (upright ? offset : 0.0), p.v + (upright ? 0.0 : offset)};
}

/// A line through points by their moments, errors taken across it.
struct Fit {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void Add(const Vec2& p) {
    n += 1, x += p.x(), y += p.y(), xx += p.x() * p.x(), xy += p.x() * p.y(), yy += p.y() * p.y();
  }
  Vec2 Mean() const { return {x / n, y / n}; }
  /// Unit vector along the line; `variance`: of the points across it.
  Vec2 Along(double& variance) const {
    const double cx = x / n, cy = y / n;
    const double a = xx / n - cx * cx, b = xy / n - cx * cy, c = yy / n - cy * cy;
    const double half = 0.5 * (a + c), root = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
    variance = std::max(0.0, half - root);
    const Vec2 one(half + root - c, b), other(b, half + root - a);
    const Vec2 best = one.squaredNorm() > other.squaredNorm() ? one : other;
    return best.squaredNorm() > 0.0 ? best.normalized() : Vec2(1.0, 0.0);
  }
};

double Across(const Vec2& p, const Vec2& mean, const Vec2& along) {
  const Vec2 d = p - mean;
  return std::abs(d.x() * along.y() - d.y() * along.x());
}

/// Whether chance would not make it: (w h)² segments could be tried; of n gradients k lie across the line. The tail of
/// the binomial is bounded by Chernoff's exp(−n KL(k/n ‖ 1/8)).
bool Meaningful(int n, int k, double tests) {
  const double share = static_cast<double>(k) / n;
  if (share <= kAligned) return false;
  double divergence = share * std::log(share / kAligned);
  if (share < 1.0) divergence += (1.0 - share) * std::log((1.0 - share) / (1.0 - kAligned));
  return tests - n * divergence <= 0.0;
}

class Fitter {
 public:
  Fitter(const Gradient& g, const LineConfig& config)
      : g_(g), config_(config), tests_(2.0 * std::log(static_cast<double>(g.width) * g.height)) {
    // The shortest that could be meaningful.
    shortest_ = static_cast<std::size_t>(std::ceil(tests_ / -std::log(kAligned)));
  }

  /// A closed edge begins anywhere, most likely within a line: it is turned so that it begins where its first line
  /// ends.
  void FitEdge(std::vector<Pixel> chain, std::vector<LineSegment>& lines) const {
    if (chain.size() < shortest_) return;
    const bool closed =
        std::abs(chain.front().u - chain.back().u) <= 2 && std::abs(chain.front().v - chain.back().v) <= 2;
    if (closed) {
      std::vector<LineSegment> unused;
      std::rotate(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(FitChain(chain, unused)), chain.end());
    }
    FitChain(chain, lines);
  }

 private:
  /// Where its first line ends; 0 where there is none.
  std::size_t FitChain(const std::vector<Pixel>& chain, std::vector<LineSegment>& lines) const {
    std::size_t first_end = 0;
    std::vector<Vec2> points;
    points.reserve(chain.size());
    for (const Pixel& p : chain) points.push_back(Refined(g_, p));
    std::size_t begin = 0;
    while (begin + shortest_ <= points.size()) {
      Fit fit;
      for (std::size_t i = begin; i < begin + shortest_; ++i) fit.Add(points[i]);
      double variance = 0.0;
      Vec2 along = fit.Along(variance);
      if (variance > 0.25 * config_.fit_error * config_.fit_error) {
        ++begin;
        continue;
      }
      std::size_t end = begin + shortest_, last = end;
      int stray = 0;
      std::size_t next_fit = 2 * shortest_;
      while (end < points.size() && stray <= kStray) {
        if (Across(points[end], fit.Mean(), along) < config_.fit_error) {
          fit.Add(points[end]);
          stray = 0;
          last = end + 1;
          if (last - begin >= next_fit) {
            along = fit.Along(variance);
            next_fit = (last - begin) + (last - begin) / 4;
          }
        } else {
          ++stray;
        }
        ++end;
      }
      along = fit.Along(variance);
      Keep(chain, points, begin, last, fit.Mean(), along, lines);
      if (first_end == 0) first_end = last;
      begin = last;
    }
    return first_end;
  }

  void Keep(const std::vector<Pixel>& chain, const std::vector<Vec2>& points, std::size_t begin, std::size_t end,
            const Vec2& mean, Vec2 along, std::vector<LineSegment>& lines) const {
    Vec2 normal(-along.y(), along.x());  // to the right of `along` as the image is looked at
    int aligned = 0;
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t at = g_.At(chain[i].u, chain[i].v);
      const Vec2 gradient(g_.x[at], g_.y[at]);
      const double across = gradient.dot(normal);
      sum += across;
      aligned += std::abs(across) > kCosine * gradient.norm() ? 1 : 0;
    }
    const int count = static_cast<int>(end - begin);
    if (!Meaningful(count, aligned, tests_)) return;
    if (sum < 0.0) {
      along = -along;
      normal = -normal;
    }
    double low = 1e9, high = -1e9;
    for (std::size_t i = begin; i < end; ++i) {
      const double t = (points[i] - mean).dot(along);
      low = std::min(low, t);
      high = std::max(high, t);
    }
    lines.push_back({mean + low * along, mean + high * along, std::abs(sum) / (8.0 * count)});
  }

  const Gradient& g_;
  const LineConfig& config_;
  double tests_;  // logarithm of their number
  std::size_t shortest_;
};

}  // namespace

std::vector<LineSegment> EdgeLines(const cv::Mat& image, const LineConfig& config) {
  const Gradient g = GradientOf(image);
  const int least = static_cast<int>(std::lround(8.0 * config.min_gradient));
  const int excess = static_cast<int>(std::lround(8.0 * config.anchor_excess));
  std::vector<std::uint8_t> taken(g.magnitude.size(), 0);
  const Fitter fitter(g, config);
  std::vector<LineSegment> lines;
  for (const Pixel& anchor : AnchorsOf(g, least, excess)) {
    const std::size_t i = g.At(anchor.u, anchor.v);
    if (taken[i] != 0) continue;
    taken[i] = 1;
    const bool upright = g.Upright(i);
    std::vector<Pixel> back, chain;
    Walk(g, least, anchor, upright ? 0 : -1, upright ? -1 : 0, taken, back);
    chain.assign(back.rbegin(), back.rend());
    chain.push_back(anchor);
    Walk(g, least, anchor, upright ? 0 : 1, upright ? 1 : 0, taken, chain);
    fitter.FitEdge(std::move(chain), lines);
  }
  return lines;
}

}  // namespace alula::stack::features
