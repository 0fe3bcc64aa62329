#include "stack/features/internal/brief_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace alula::stack::features::internal {
namespace {

constexpr int kRadius = kPatchRadius;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kTests = 256;
constexpr int kCandidates = 3000;
constexpr double kRange = 6.0;        // ρ, px: of smoothed pictures of rooms and woods
constexpr double kShortest = 5.0;     // px between the points of a test: shorter ones tell noise
constexpr std::uint64_t kSeed = 256;  // any

/// C over differences of places, so that the search only looks up.
class Covariance {
 public:
  Covariance() {
    for (int v = -2 * kRadius; v <= 2 * kRadius; ++v) {
      for (int u = -2 * kRadius; u <= 2 * kRadius; ++u) {
        table_[Index(u, v)] = 1.0 / (1.0 + (u * u + v * v) / (kRange * kRange));
      }
    }
  }
  double operator()(int u, int v) const { return table_[Index(u, v)]; }

 private:
  static constexpr int kWidth = 4 * kRadius + 1;
  static std::size_t Index(int u, int v) {
    return static_cast<std::size_t>((v + 2 * kRadius) * kWidth + u + 2 * kRadius);
  }
  std::array<double, kWidth * kWidth> table_{};
};

struct Moments {
  double u = 0.0, v = 0.0;  // of m10 and m01
};

/// Cov(I(a), m) for a place a, and Var(m10) = Var(m01).
struct MomentCovariance {
  std::array<Moments, kSide * kSide> at{};
  double variance = 0.0;

  explicit MomentCovariance(const Covariance& covariance) {
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -RowHalf(y); x <= RowHalf(y); ++x) {
        Moments sum;
        for (int v = -kRadius; v <= kRadius; ++v) {
          for (int u = -RowHalf(v); u <= RowHalf(v); ++u) {
            const double c = covariance(x - u, y - v);
            sum.u += u * c;
            sum.v += v * c;
          }
        }
        at[Index(x, y)] = sum;
        variance += x * sum.u;
      }
    }
  }
  static std::size_t Index(int x, int y) { return static_cast<std::size_t>((y + kRadius) * kSide + x + kRadius); }
};

struct Test {
  int ax = 0, ay = 0, bx = 0, by = 0;
  Moments with_m;          // Cov(d, m)
  double sigma = 0.0;      // of d given m
  double known = 0.0;      // |what m10 says of d| / sigma
  double correlation = 0;  // largest with a test taken
};

class Search {
 public:
  std::vector<Test> Candidates() const {
    base::RandomStream random(kSeed, "features/brief");
    const auto place = [&] { return static_cast<int>(random.Index(kSide)) - kRadius; };
    std::vector<Test> tests;
    while (tests.size() < kCandidates) {
      Test t;
      t.ax = place(), t.ay = place(), t.bx = place(), t.by = place();
      const int du = t.ax - t.bx, dv = t.ay - t.by;
      const auto inside = [](int x, int y) { return x * x + y * y <= kRadius * kRadius; };
      if (!inside(t.ax, t.ay) || !inside(t.bx, t.by) || du * du + dv * dv < kShortest * kShortest) continue;
      const Moments& a = moments_.at[MomentCovariance::Index(t.ax, t.ay)];
      const Moments& b = moments_.at[MomentCovariance::Index(t.bx, t.by)];
      t.with_m = {a.u - b.u, a.v - b.v};
      t.sigma = std::sqrt(GivenMoments(t, t));
      t.known = std::abs(t.with_m.u) / (t.sigma * std::sqrt(moments_.variance));
      tests.push_back(t);
    }
    std::stable_sort(tests.begin(), tests.end(), [](const Test& a, const Test& b) { return a.known < b.known; });
    tests.resize(kCandidates / 2);
    return tests;
  }

  /// Cov(d_s, d_t | m).
  double GivenMoments(const Test& s, const Test& t) const {
    const double free = covariance_(s.ax - t.ax, s.ay - t.ay) - covariance_(s.ax - t.bx, s.ay - t.by) -
                        covariance_(s.bx - t.ax, s.by - t.ay) + covariance_(s.bx - t.bx, s.by - t.by);
    return free - (s.with_m.u * t.with_m.u + s.with_m.v * t.with_m.v) / moments_.variance;
  }

 private:
  Covariance covariance_;
  MomentCovariance moments_{covariance_};
};

BriefPattern MakePattern() {
  const Search search;
  std::vector<Test> tests = search.Candidates();
  BriefPattern pattern{};
  std::size_t next = 0;  // the least known of all
  for (std::size_t i = 0; i < kTests; ++i) {
    const Test taken = tests[next];
    pattern.ax[i] = static_cast<float>(taken.ax);
    pattern.ay[i] = static_cast<float>(taken.ay);
    pattern.bx[i] = static_cast<float>(taken.bx);
    pattern.by[i] = static_cast<float>(taken.by);
    for (Test& t : tests) {
      const double correlation = std::abs(search.GivenMoments(taken, t)) / (taken.sigma * t.sigma);
      t.correlation = std::max(t.correlation, correlation);
    }
    next = static_cast<std::size_t>(
        std::min_element(tests.begin(), tests.end(),
                         [](const Test& a, const Test& b) { return a.correlation < b.correlation; }) -
        tests.begin());
  }
  return pattern;
}

}  // namespace

const BriefPattern& Pattern() {
  static const BriefPattern pattern = MakePattern();
  return pattern;
}

}  // namespace alula::stack::features::internal
