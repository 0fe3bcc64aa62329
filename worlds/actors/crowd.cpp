#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "worlds/actors/outline.h"
#include "worlds/actors/person.h"
#include "worlds/kit/terrain.h"

namespace alula::worlds {
namespace {

using base::RandomStream;
using base::Vec2;

/// Where a crowd may walk.
class Walkable {
 public:
  Walkable(const World& world, const CrowdConfig& config) : config_(config) {
    constexpr double kTallest = 2.0;  // m
    for (const Outline& outline : OutlinesOf(world)) {
      const double z = HeightOf(outline.centre);
      if (outline.high > z + 0.1 && outline.low < z + kTallest) outlines_.push_back(outline);
    }
  }

  double HeightOf(const Vec2& p) const { return config_.ground ? HeightAt(*config_.ground, p) : 0.0; }
  bool IsFree(const Vec2& a, const Vec2& b) const {
    for (const KeptFree& free : config_.free) {
      if (DistanceTo(free.centre, a, b) < free.radius + config_.room) return false;
    }
    return std::all_of(outlines_.begin(), outlines_.end(),
                       [&](const Outline& outline) { return IsClear(outline, a, b, config_.room); });
  }
  Vec2 Draw(RandomStream& random) const {
    return {random.Uniform(config_.low.x(), config_.high.x()), random.Uniform(config_.low.y(), config_.high.y())};
  }

 private:
  static double DistanceTo(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 line = b - a;
    const double s = std::clamp((p - a).dot(line) / std::max(line.squaredNorm(), 1e-12), 0.0, 1.0);
    return (p - a - s * line).norm();
  }

  const CrowdConfig& config_;
  std::vector<Outline> outlines_;
};

/// A route of up to five lines; fewer than two points where none was found.
std::vector<Vec2> DrawRoute(const Walkable& walkable, const CrowdConfig& config, const std::vector<Vec2>& starts,
                            RandomStream& random) {
  constexpr int kTries = 400;
  constexpr double kApart = 1.0;  // m, of starts
  constexpr std::size_t kLines = 5;
  const double shortest = 0.15 * (config.high - config.low).norm();
  std::vector<Vec2> route;
  for (int i = 0; i < kTries && route.empty(); ++i) {
    const Vec2 p = walkable.Draw(random);
    const auto far = [&p](const Vec2& q) { return (p - q).norm() >= kApart; };
    if (std::all_of(starts.begin(), starts.end(), far) && walkable.IsFree(p, p)) route.push_back(p);
  }
  for (int i = 0; i < kTries && !route.empty() && route.size() <= kLines; ++i) {
    const Vec2 p = walkable.Draw(random);
    // Long lines first: after half of the tries any will do.
    const double least = i < kTries / 2 ? shortest : std::min(1.0, shortest);
    if ((p - route.back()).norm() >= least && walkable.IsFree(route.back(), p)) route.push_back(p);
  }
  return route;
}

}  // namespace

void AddCrowd(World& world, const std::string& name, const CrowdConfig& config, std::uint64_t seed) {
  if (config.count <= 0) return;
  const Walkable walkable(world, config);
  RandomStream random(seed, "world/actors/" + name);
  std::vector<Vec2> starts;
  for (int i = 0; i < config.count; ++i) {
    const std::string own = name + std::to_string(i);
    constexpr int kStarts = 20;  // a place may be free and lead nowhere
    std::vector<Vec2> route;
    for (int k = 0; k < kStarts && route.size() < 2; ++k) route = DrawRoute(walkable, config, starts, random);
    if (route.size() < 2) {
      throw base::InputError(name + ": no free room for " + std::to_string(config.count) + " people (" +
                             std::to_string(i) + " found a way); ask for fewer");
    }
    Walk walk{.speed = config.speed * std::clamp(1.0 + 0.15 * random.Gaussian(), 0.6, 1.4),
              .height = PersonHeight(seed, own),
              .reactive = config.reactive,
              .ground = config.ground};
    for (const Vec2& p : route) walk.route.emplace_back(p.x(), p.y(), walkable.HeightOf(p));
    starts.push_back(route.front());
    AddPerson(world, own, walk, seed);
  }
}

}  // namespace alula::worlds
