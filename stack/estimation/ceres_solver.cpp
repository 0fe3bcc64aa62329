#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "stack/estimation/internal/pose_manifold.h"
#include "stack/estimation/internal/prior_factor.h"
#include "stack/estimation/internal/window_problem.h"

namespace alula::stack::estimation {

SolverSummary SolveWithCeres(const WindowProblem& problem, const SolverLimits& limits) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem twin(ownership);
  PoseManifold manifold;
  ceres::HuberLoss huber(problem.huber);
  PriorFactor prior(*problem.prior);
  auto* ordering = new ceres::ParameterBlockOrdering;
  // Ceres wants factors that it may change; it does not.
  const auto mutable_cost = [](const ceres::CostFunction* cost) { return const_cast<ceres::CostFunction*>(cost); };

  for (const WindowProblem::State& state : problem.states) {
    if (state.kind == BlockKind::kPose) {
      twin.AddParameterBlock(state.x, kPoseSize, &manifold);
    } else {
      twin.AddParameterBlock(state.x, AmbientSize(state.kind));
    }
    if (state.constant) twin.SetParameterBlockConstant(state.x);
    ordering->AddElementToGroup(state.x, 1);
  }
  std::vector<double*> blocks;
  for (const WindowProblem::Factor& factor : problem.factors) {
    blocks.clear();
    for (const int i : factor.states) blocks.push_back(problem.states[static_cast<std::size_t>(i)].x);
    twin.AddResidualBlock(mutable_cost(factor.cost), nullptr, blocks);
  }
  blocks.clear();
  for (const LinearBlock& block : problem.prior->blocks) blocks.push_back(block.x);
  twin.AddResidualBlock(&prior, nullptr, blocks);
  double* rig = problem.states[static_cast<std::size_t>(problem.rig)].x;
  for (const WindowProblem::Landmark& landmark : problem.landmarks) {
    twin.AddParameterBlock(landmark.x, landmark.kind->ambient, landmark.kind->manifold);
    ordering->AddElementToGroup(landmark.x, 0);
    for (int i = 0; i < landmark.count; ++i) {
      const WindowProblem::Sight& sight = problem.sights[static_cast<std::size_t>(landmark.first + i)];
      double* pose = problem.states[static_cast<std::size_t>(sight.pose)].x;
      twin.AddResidualBlock(mutable_cost(sight.cost), &huber, pose, landmark.x, rig);
    }
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering.reset(ordering);
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.initial_trust_region_radius = limits.radius;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = limits.function_tolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &twin, &summary);
  return {summary.IsSolutionUsable(), summary.initial_cost, summary.final_cost,
          static_cast<int>(summary.iterations.size()) - 1};
}

}  // namespace alula::stack::estimation
