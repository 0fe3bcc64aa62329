#include "scenarios/trajectory/relative_error.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace alula::scenarios::trajectory {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Way {
  double metres = 0.0, degrees = 0.0;
};
Way ErrorOf(const PosePair& i, const PosePair& j) {
  const base::Transform F = (i.truth.Inverse() * j.truth).Inverse() * (i.estimate.Inverse() * j.estimate);
  return {F.p.norm(), base::Log(F.q).norm() * kDegrees};
}

/// Sums up errors of single ways.
struct Errors {
  std::vector<double> metres, degrees, percent;

  void Add(const Way& way) {
    metres.push_back(way.metres);
    degrees.push_back(way.degrees);
  }
  RelativeError Sum() && {
    return {StatisticsOf(std::move(metres)), StatisticsOf(std::move(degrees)), StatisticsOf(std::move(percent))};
  }
};

/// The longest of 100, 10 and 1 m that the path has.
double UnitOf(double path) {
  for (const double unit : {100.0, 10.0, 1.0}) {
    if (path >= unit) return unit;
  }
  return 0.0;
}

}  // namespace

RelativeError RelativeErrorOverTime(const std::vector<PosePair>& pairs, base::Duration step) {
  Errors errors;
  std::size_t j = 0;
  const auto off = [&](std::size_t i, std::size_t k) { return std::abs((pairs[k].time - pairs[i].time - step).ns); };
  constexpr std::int64_t kNearEnough = 20;  // a twentieth of the step
  for (std::size_t i = 0; i < pairs.size() && pairs[i].time + step <= pairs.back().time; ++i) {
    while (j + 1 < pairs.size() && off(i, j + 1) <= off(i, j)) ++j;
    if (kNearEnough * off(i, j) < step.ns) errors.Add(ErrorOf(pairs[i], pairs[j]));
  }
  return std::move(errors).Sum();
}

RelativeError RelativeErrorOverPath(const std::vector<PosePair>& pairs, double length) {
  const std::vector<double> path = PathOf(pairs);
  Errors errors;
  std::size_t j = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    while (j < pairs.size() && path[j] - path[i] < length) ++j;
    if (j == pairs.size()) break;
    const Way way = ErrorOf(pairs[i], pairs[j]);
    errors.Add(way);
    errors.percent.push_back(100.0 * way.metres / (path[j] - path[i]));
  }
  return std::move(errors).Sum();
}

PathDrift PathDriftOf(const std::vector<PosePair>& pairs) {
  constexpr std::size_t kEvery = 10;
  constexpr int kLengths = 8;
  const std::vector<double> path = PathOf(pairs);
  PathDrift drift;
  if (path.empty() || UnitOf(path.back()) == 0) return drift;
  drift.unit = UnitOf(path.back());
  for (int k = 1; k <= kLengths; ++k) {
    const double length = k * drift.unit;
    std::size_t j = 0;
    for (std::size_t i = 0; i < pairs.size(); i += kEvery) {
      while (j < pairs.size() && path[j] - path[i] < length) ++j;
      if (j == pairs.size()) break;
      const Way way = ErrorOf(pairs[i], pairs[j]);
      ++drift.ways;
      drift.percent += 100.0 * way.metres / length;
      drift.degrees_per_metre += way.degrees / length;
    }
  }
  drift.percent /= static_cast<double>(drift.ways);
  drift.degrees_per_metre /= static_cast<double>(drift.ways);
  return drift;
}

EndError EndErrorOf(const std::vector<PosePair>& pairs) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (pairs.empty()) return {kNone, kNone};
  const double path = PathOf(pairs).back();
  const double metres = ErrorOf(pairs.front(), pairs.back()).metres;
  return {metres, path > 0 ? 100.0 * metres / path : kNone};
}

}  // namespace alula::scenarios::trajectory
