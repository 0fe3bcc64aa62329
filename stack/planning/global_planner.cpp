#include "stack/planning/global_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/random.h"
#include "stack/planning/internal/informed_rrt_star.h"

namespace alula::stack::planning {

using base::Vec3;

namespace {

using Path = std::vector<Vec3>;

/// Drops every point that its neighbours can do without, farthest jumps first.
Path Prune(const Path& path, const SegmentChecker& checker) {
  Path result{path.front()};
  std::size_t i = 0;
  while (i + 1 < path.size()) {
    std::size_t j = path.size() - 1;
    while (j > i + 1 && !checker.SegmentFree(path[i], path[j])) --j;
    result.push_back(path[j]);
    i = j;
  }
  return result;
}

double Length(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Joins two random points of the path by a straight line where that is free: shorter by the triangle inequality.
Path Shortcut(Path path, const SegmentChecker& checker, int rounds, base::RandomStream& random) {
  for (int round = 0; round < rounds && path.size() > 2; ++round) {
    const double total = Length(path);
    double from = random.Uniform(0.0, total);
    double to = random.Uniform(0.0, total);
    if (from > to) std::swap(from, to);
    Path candidate;
    Vec3 a = path.front(), b = path.back();
    double s = 0.0;
    bool joined = false;
    candidate.push_back(path.front());
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double span = (path[i] - path[i - 1]).norm();
      const auto at = [&](double x) { return Vec3(path[i - 1] + (path[i] - path[i - 1]) * ((x - s) / span)); };
      if (from >= s && from < s + span) a = at(from);
      if (to >= s && to < s + span) {
        b = at(to);
        candidate.push_back(a);
        candidate.push_back(b);
        joined = true;
      }
      s += span;
      if (s <= from || joined) candidate.push_back(path[i]);
    }
    if (joined && checker.SegmentFree(a, b)) path = Prune(candidate, checker);
  }
  return path;
}

/// What is left of the path flown so far: from the start straight to the farthest point that can be reached.
std::optional<Path> Continue(const PlanRequest& request, const SegmentChecker& checker) {
  if (request.previous.empty()) return std::nullopt;
  for (std::size_t j = request.previous.size(); j-- > 0;) {
    if (!checker.SegmentFree(request.start_O, request.previous[j])) continue;
    Path path{request.start_O};
    path.insert(path.end(), request.previous.begin() + static_cast<std::ptrdiff_t>(j), request.previous.end());
    path.push_back(request.goal_O);
    if (checker.PathFree(path)) return Prune(path, checker);
    return std::nullopt;
  }
  return std::nullopt;
}

class InformedRrtStarPlanner : public GlobalPlanner {
 public:
  explicit InformedRrtStarPlanner(const GlobalPlannerConfig& config) : config_(config) {}

  PlanResult Plan(const PlanRequest& request) override {
    const SegmentChecker checker(request, config_);
    PlanResult result;
    result.reason = checker.relaxed();
    if (checker.goal_blocked()) return result;
    const auto found = [&result](Path path, PlanResult::Source source) {
      result.found = true;
      result.path_O = std::move(path);
      result.source = source;
      return result;
    };
    if (checker.SegmentFree(request.start_O, request.goal_O)) {
      return found({request.start_O, request.goal_O}, PlanResult::Source::kStraight);
    }
    if (auto path = Continue(request, checker)) return found(std::move(*path), PlanResult::Source::kPrevious);
    if (auto path = internal::SearchInformedRrtStar(request, checker, config_)) {
      base::RandomStream random(request.seed, "planner/" + std::to_string(request.number) + "/shortcut");
      return found(Shortcut(Prune(*path, checker), checker, config_.shortcut_rounds, random),
                   PlanResult::Source::kSearch);
    }
    if (!result.reason.empty()) result.reason += "; ";
    result.reason +=
        fmt::format("no path with {:.2f} m of clearance found in {} iterations", request.clearance, config_.iterations);
    return result;
  }

 private:
  GlobalPlannerConfig config_;
};

}  // namespace

void Describe(base::Description& d, GlobalPlannerConfig& c) {
  d.Field("iterations", c.iterations, {.meaning = "rounds of Informed-RRT*", .min = 10, .max = 1000000});
  d.Field("range", c.range, {.unit = "m", .meaning = "longest edge of the tree", .min = 0.1, .max = 50});
  d.Field("goal_bias", c.goal_bias, {.meaning = "share of samples at the goal", .min = 0, .max = 0.9});
  d.Field("max_climb_angle", c.max_climb_angle,
          {.unit = "rad", .meaning = "steeper flight leaves the camera's view", .min = 0.05, .max = 1.5});
  d.Field("height_min", c.height_min, {.unit = "m", .meaning = "lowest flight above the ground", .min = 0, .max = 100});
  d.Field("height_max", c.height_max,
          {.unit = "m", .meaning = "highest flight above the ground", .min = 0.5, .max = 200});
  d.Field("climb_cost", c.climb_cost,
          {.meaning = "length of a metre of height against one of ground, in the search", .min = 0.1, .max = 20});
  d.Field("start_cone", c.start_cone,
          {.meaning = "clearance regained per metre where start or goal is too near to things", .min = 0.05, .max = 1});
  d.Field("shortcut_rounds", c.shortcut_rounds, {.meaning = "random shortcuts tried", .min = 0, .max = 10000});
}

std::unique_ptr<GlobalPlanner> MakeInformedRrtStarPlanner(const GlobalPlannerConfig& config) {
  return std::make_unique<InformedRrtStarPlanner>(config);
}

}  // namespace alula::stack::planning
