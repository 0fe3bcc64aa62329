#include "stack/planning/internal/informed_rrt_star.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <mutex>

#include "base/random.h"

namespace alula::stack::planning::internal {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using base::Vec3;

namespace {

/// The search space is stretched along z, so that its path lengths are the costs wanted.
Vec3 PointOf(const ob::State* state, double climb_cost) {
  const auto* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1], values[2] / climb_cost};
}

class PointValidity : public ob::StateValidityChecker {
 public:
  PointValidity(const ob::SpaceInformationPtr& space, const SegmentChecker& checker, double climb_cost)
      : ob::StateValidityChecker(space), checker_(checker), climb_cost_(climb_cost) {}
  bool isValid(const ob::State* state) const override { return checker_.PointFree(PointOf(state, climb_cost_)); }

 private:
  const SegmentChecker& checker_;
  double climb_cost_;
};

/// The planner's edges are checked exactly as the flown path is (OMPL's own check steps by 1 % of the space).
class SegmentValidity : public ob::MotionValidator {
 public:
  SegmentValidity(const ob::SpaceInformationPtr& space, const SegmentChecker& checker, double climb_cost)
      : ob::MotionValidator(space), checker_(checker), climb_cost_(climb_cost) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return checker_.SegmentFree(PointOf(a, climb_cost_), PointOf(b, climb_cost_));
  }
  bool checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(a, b)) return true;
    last_valid.second = 0.0;
    return false;
  }

 private:
  const SegmentChecker& checker_;
  double climb_cost_;
};

std::mutex& OmplMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

std::optional<std::vector<Vec3>> SearchInformedRrtStar(const PlanRequest& request, const SegmentChecker& checker,
                                                       const GlobalPlannerConfig& config) {
  // OMPL seeds all its generators from one global one: nobody else may draw from it meanwhile.
  const std::lock_guard lock(OmplMutex());
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  base::RandomStream seeds(request.seed, "planner/" + std::to_string(request.number));
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(1 + seeds.Index(0x7ffffffe)));

  auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  const Vec3 scale(1.0, 1.0, config.climb_cost);
  for (unsigned i = 0; i < 3; ++i) {
    bounds.setLow(i, checker.low()[i] * scale[i] - 1e-6);
    bounds.setHigh(i, checker.high()[i] * scale[i] + 1e-6);
  }
  space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker(std::make_shared<PointValidity>(information, checker, config.climb_cost));
  information->setMotionValidator(std::make_shared<SegmentValidity>(information, checker, config.climb_cost));
  information->setup();

  ob::ScopedState<ob::RealVectorStateSpace> start(space);
  ob::ScopedState<ob::RealVectorStateSpace> goal(space);
  for (unsigned i = 0; i < 3; ++i) {
    start[i] = request.start_O[i] * scale[i];
    goal[i] = request.goal_O[i] * scale[i];
  }
  auto problem = std::make_shared<ob::ProblemDefinition>(information);
  problem->setStartAndGoalStates(start, goal, 1e-6);
  problem->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(information));

  og::InformedRRTstar planner(information);
  planner.setRange(config.range);
  planner.setGoalBias(config.goal_bias);
  planner.setProblemDefinition(problem);
  planner.setup();
  ob::IterationTerminationCondition budget(static_cast<unsigned>(config.iterations));
  const ob::PlannerStatus status = planner.solve(budget);
  if (status != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
  auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
  std::vector<Vec3> points;
  for (ob::State* const state : path->getStates()) points.push_back(PointOf(state, config.climb_cost));
  return points;
}

}  // namespace alula::stack::planning::internal
