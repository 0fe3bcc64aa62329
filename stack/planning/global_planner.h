#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "stack/mapping/clearance_field.h"

namespace alula::stack::planning {

/// An opening that a path may not cross (a gate whose turn has not come, or not from this side).
struct ClosedOpening {
  base::Transform X_OG;
  double half = 0.0;  // half side, m
};

struct GlobalPlannerConfig {
  int iterations = 2500;          // of Informed-RRT*; a budget is a count, never a clock
  double range = 2.5;             // m, longest edge
  double goal_bias = 0.08;        // share of samples at the goal
  double max_climb_angle = 0.49;  // rad (28°): steeper flight leaves the camera's view
  double height_min = 0.45;       // m above the ground of the odometry frame's start
  double height_max = 6.0;        // m
  double climb_cost = 2.0;        // length of a metre of height against a metre of ground: around rather than over
  double start_cone = 0.3;        // m of clearance regained per m of flight, where start or goal is too near to things
  int shortcut_rounds = 60;       // random shortcuts tried on the found path
};
void Describe(base::Description& d, GlobalPlannerConfig& c);

/// One question to a planner. Everything is in the odometry frame O; unknown space counts as free ("optimistic").
struct PlanRequest {
  std::shared_ptr<const mapping::ClearanceField> field;
  base::Vec3 start_O = base::Vec3::Zero();
  base::Vec3 goal_O = base::Vec3::Zero();
  double clearance = 0.35;        // m, wanted between the path and anything occupied
  double clearance_floor = 0.24;  // m, what start and goal may relax it to in their neighbourhood
  base::Vec3 bounds_low_O = base::Vec3::Zero();
  base::Vec3 bounds_high_O = base::Vec3::Zero();
  double ground_O = 0.0;  // height that height_min and height_max count from, m
  std::vector<ClosedOpening> closed;
  std::vector<base::Vec3> previous;  // interior points of the path flown so far: kept where it still holds
  bool limit_climb = true;
  std::uint64_t seed = 0;  // with `number` it seeds all that is random
  std::uint64_t number = 0;
};

struct PlanResult {
  bool found = false;
  /// Why nothing was found, or what was relaxed; empty when all was as wished.
  std::string reason;
  std::vector<base::Vec3> path_O;  // start … goal, m
  enum class Source { kNone, kStraight, kPrevious, kSearch } source = Source::kNone;
};

/// Finds a polyline of checked segments.
class GlobalPlanner {
 public:
  virtual ~GlobalPlanner() = default;
  virtual PlanResult Plan(const PlanRequest& request) = 0;
};

/// The straight line where it is clear, else the previous path where it still is, else Informed-RRT* (Gammell et al.
/// 2014, through OMPL) and shortcuts. Deterministic in the request. OMPL's global generator is seeded anew in each
/// call, under a lock: calls from several threads are safe and run one after another.
std::unique_ptr<GlobalPlanner> MakeInformedRrtStarPlanner(const GlobalPlannerConfig& config);

/// Exact test of segments for one request: clearance(p) ≥ required(p) on all of it, inside the bounds, not steeper than
/// allowed, through no closed opening. `required` is `clearance`, relaxed in cones about a start or goal that is too
/// near to something. The field is 1-Lipschitz, so steps of (clearance − required)/(1 + cone) skip nothing.
class SegmentChecker {
 public:
  SegmentChecker(const PlanRequest& request, const GlobalPlannerConfig& config);

  double Required(const base::Vec3& p_O) const;
  bool PointFree(const base::Vec3& p_O) const;
  bool SegmentFree(const base::Vec3& a_O, const base::Vec3& b_O) const;
  bool PathFree(const std::vector<base::Vec3>& path_O) const;
  /// What was relaxed about start and goal, or why the goal cannot be reached; empty where nothing.
  const std::string& relaxed() const { return relaxed_; }
  bool goal_blocked() const { return goal_blocked_; }
  const base::Vec3& low() const { return low_; }
  const base::Vec3& high() const { return high_; }

 private:
  const PlanRequest& request_;
  double cone_;
  double tan_climb_;
  double start_clearance_;
  double goal_clearance_;
  base::Vec3 low_;
  base::Vec3 high_;
  std::string relaxed_;
  bool goal_blocked_ = false;
};

}  // namespace alula::stack::planning
